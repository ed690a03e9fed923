"""`farm flower`: the live view of tasks and workers."""

import importlib.util
import os
import sys
from typing import Annotated

import typer

from farm.cli.options import Broker
from farm.errors import EnvironmentMissingError
from farm.queue.broker import broker_url, connect


def flower(
    broker: Broker = None,
    address: Annotated[str, typer.Option(help="Flower has no password: keep it on this machine.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=1, max=65535)] = 5555,
) -> None:
    """Start Flower, the live view of tasks and workers in a browser."""
    if importlib.util.find_spec("flower") is None:
        raise EnvironmentMissingError("Flower is not installed; run: pip install 'cable-farm[flower]'")
    url = broker_url(broker)
    connect(url).close()
    command = [sys.executable, "-P", "-m", "celery", "flower", f"--address={address}", f"--port={port}"]
    typer.echo(f"Flower: http://{address}:{port}")
    sys.stdout.flush()
    # Celery reads the address from the environment; arguments, and a password in them, can be seen by all.
    os.execve(command[0], command, {**os.environ, "BROKER_URL": url})  # noqa: S606 - no shell is wanted
