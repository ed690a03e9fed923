"""A worker container's health check: exit code 0 if its worker answers a question sent through Redis."""

import os
import sys

from farm.run.queue.broker import broker_url
from farm.run.queue.settings import make_app

_WAIT_S = 10.0

if __name__ == "__main__":
    # Celery's main process answers, also while its child renders.
    worker = f"worker@{os.uname().nodename}"
    answers = make_app(broker_url(None)).control.inspect([worker], timeout=_WAIT_S, limit=1).ping()
    sys.exit(0 if answers else 1)
