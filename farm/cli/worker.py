"""`farm worker`: take jobs and make their pictures until told to stop."""

import os
from typing import Annotated

import typer

from assets.surfaces.catalogue import SURFACES
from farm.cli.baking import bake
from farm.cli.display import console
from farm.cli.options import Assets, Broker, Device, Logs, MinFree, log_folder
from farm.cli.worker_program import become_worker, check_device, require_blender
from farm.machine import usable_cores
from farm.run.queue.broker import broker_url, wait_for
from farm.run.worker_settings import (
    HARD_LIMIT_S,
    MEMORY_PER_CHILD_KIB,
    MIN_FREE_MIB,
    TASKS_PER_CHILD,
    DeviceChoice,
    RendererSettings,
    WorkerSettings,
)
from farm.storage import find_folder, open_storage


def worker(  # noqa: PLR0913, PLR0917 - every option is a parameter
    store: Annotated[
        str, typer.Option(envvar="FARM_STORE", help="Folder or URL below which the datasets lie.", show_default=False)
    ],
    broker: Broker = None,
    device: Device = DeviceChoice.AUTO,
    threads: Annotated[
        int | None, typer.Option(min=1, help="Threads of each renderer; default: the cores divided by the concurrency.")
    ] = None,
    concurrency: Annotated[int, typer.Option(min=1, help="Pictures at a time, each with a Blender of its own.")] = 1,
    name: Annotated[str | None, typer.Option(help="Name of the worker, unique on this host; Flower shows it.")] = None,
    tasks_per_child: Annotated[
        int, typer.Option(min=1, help="Pictures after which a Blender is replaced.")
    ] = TASKS_PER_CHILD,
    memory_per_child_mib: Annotated[
        int, typer.Option(min=256, help="MiB of memory above which a Blender is replaced.")
    ] = MEMORY_PER_CHILD_KIB // 1024,
    time_limit_s: Annotated[
        float, typer.Option(min=1, max=HARD_LIMIT_S, help="Seconds after which a job's process is killed.")
    ] = HARD_LIMIT_S,
    min_free_mib: MinFree = MIN_FREE_MIB,
    broker_wait_s: Annotated[
        float, typer.Option(min=0, help="Seconds to wait for a Redis that is not there yet.")
    ] = 0.0,
    assets: Assets = None,
    logs: Logs = None,
) -> None:
    """Make pictures for the datasets of a store until stopped; Ctrl-C lets the running one end."""
    require_blender()
    url = broker_url(broker)
    wait_for(url, broker_wait_s)
    store = store if "://" in store else str(find_folder(store))
    open_storage(store).is_empty()  # it may be empty or not there yet, but must be readable
    check_device(device, log_folder(logs))
    bake(SURFACES, assets, console())
    threads = threads or max(1, usable_cores() // concurrency)
    settings = WorkerSettings(
        store=store,
        name=name or f"worker-{os.getpid()}",
        logs=log_folder(logs),
        renderer=RendererSettings(device=device, threads=threads, assets=assets),
        concurrency=concurrency,
        tasks_per_child=tasks_per_child,
        memory_per_child_kib=memory_per_child_mib * 1024,
        time_limit_s=time_limit_s,
        min_free_mib=min_free_mib,
    )
    become_worker(settings, url)
