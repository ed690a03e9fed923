"""What each floor surface costs to render, beside a plain one."""
