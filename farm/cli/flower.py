"""`farm flower`: the live view of tasks and workers."""

import importlib.util
import ipaddress
import os
import sys
from typing import Annotated

import typer

from farm.cli.options import Broker
from farm.errors import MachineError, SpecError
from farm.run.queue.broker import broker_url, connect

_PASSWORD_VARIABLE = "FLOWER_BASIC_AUTH"  # noqa: S105 - a name, no password


def flower(
    broker: Broker = None,
    address: Annotated[str, typer.Option(help="Any but this machine's own needs FLOWER_BASIC_AUTH.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=1, max=65535)] = 5555,
) -> None:
    """Start Flower, the live view of tasks and workers in a browser.

    Whoever reaches it can stop workers; with FLOWER_BASIC_AUTH=USER:PASSWORD in the environment it asks for both.
    """
    _check_password(address)
    if importlib.util.find_spec("flower") is None:
        raise MachineError("Flower is not installed; run: pip install 'cable-farm[flower]'")
    url = broker_url(broker)
    connect(url).close()
    command = [sys.executable, "-P", "-m", "celery", "flower", f"--address={address}", f"--port={port}"]
    typer.echo(f"Flower: http://{address}:{port}")
    sys.stdout.flush()
    # Celery reads the address from the environment; arguments, and a password in them, can be seen by all.
    os.execve(command[0], command, {**os.environ, "BROKER_URL": url})  # noqa: S606 - no shell is wanted


def _check_password(address: str) -> None:
    """Refuse to let the network in without a password.

    Raises:
        SpecError: if there is none, or one that Flower can't use.
    """
    given = os.environ.get(_PASSWORD_VARIABLE, "")
    # Flower takes users divided by commas.
    pairs = [user.strip().partition(":") for user in given.split(",")] if given else []
    if not all(name and password for name, _, password in pairs):
        raise SpecError(f"{_PASSWORD_VARIABLE}: write it as USER:PASSWORD, neither of them empty")
    if not pairs and not _is_loopback(address):
        raise SpecError(
            f"--address {address}: whoever reaches Flower can stop workers; set {_PASSWORD_VARIABLE}=USER:PASSWORD in "
            "the environment, or keep to 127.0.0.1"
        )


def _is_loopback(address: str) -> bool:
    # Another name might be resolved to anything, and an empty one is all of this machine's addresses.
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False
