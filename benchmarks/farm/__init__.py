"""Images per hour of a whole farm on this machine, for several ways to split its cores between workers."""
