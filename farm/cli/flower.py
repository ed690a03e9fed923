"""`farm flower`: starts Flower, the live view of tasks and workers in a browser."""

import importlib.util
import ipaddress
import os
from typing import Annotated

import typer

from farm.cli.options import Broker
from farm.errors import MachineError, SpecError
from farm.run.queue.broker import BROKER_VARIABLE, broker_url, connect
from farm.run.queue.settings import make_app
from farm.start import become

_OF_CELERYS_COMMAND = ("APP", "BROKER_URL", "RESULT_BACKEND", "LOADER", "CONFIG_MODULE", "WORKDIR", "SKIP_CHECKS")
"""Variables that Celery's command takes for its options. Their names are so common that other programs set them."""

_PASSWORD_VARIABLE = "FLOWER_BASIC_AUTH"  # noqa: S105 - a name, no password


def flower(
    broker: Broker = None,
    address: Annotated[str, typer.Option(help="Address to listen at; others need FLOWER_BASIC_AUTH.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=1, max=65535, help="Port to listen at.")] = 5555,
) -> None:
    """Start Flower, the live view of tasks and workers in a browser.

    Anybody who reaches Flower can stop workers. With FLOWER_BASIC_AUTH=USER:PASSWORD in the environment it asks for
    both.
    """
    _check_password(address)
    if importlib.util.find_spec("flower") is None:
        raise MachineError("Flower is not installed; run: pip install 'cable-farm[flower]'")
    url = broker_url(broker)
    connect(url).close()
    typer.echo(f"Flower: http://{address}:{port}")
    # The broker's address goes by the environment: every user sees arguments, and a password in them.
    become("farm.cli.flower", [f"--address={address}", f"--port={port}"], **{BROKER_VARIABLE: url})


def main(arguments: list[str]) -> None:
    """Run Flower in this process; `farm.start` calls it.

    Args:
        arguments: Flower's own options.
    """
    for name in _OF_CELERYS_COMMAND:
        os.environ.pop(name, None)
    # Flower would run a file of settings that lies in the working folder.
    make_app(broker_url(None)).start(["flower", f"--conf={os.devnull}", *arguments])


def _check_password(address: str) -> None:
    """Refuse to listen to the network without a password.

    Args:
        address: address to listen at.

    Raises:
        SpecError: if the address is not this machine's own and no password is set, or if Flower can't use it.
    """
    given = os.environ.get(_PASSWORD_VARIABLE, "")
    # Flower takes a list of users, separated by commas.
    pairs = [user.strip().partition(":") for user in given.split(",")] if given else []
    if not all(name and password for name, _, password in pairs):
        raise SpecError(f"{_PASSWORD_VARIABLE}: write it as USER:PASSWORD, neither of them empty")
    if not pairs and not _is_loopback(address):
        raise SpecError(
            f"--address {address}: anybody who reaches Flower can stop workers; set {_PASSWORD_VARIABLE}=USER:PASSWORD "
            "in the environment, or keep to 127.0.0.1"
        )


def _is_loopback(address: str) -> bool:
    # Another name may resolve to any address, and an empty one means all of this machine's addresses.
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False
