"""The renderer of one process: opened for the first job of a dataset, kept for those that follow."""

import errno
import logging
import os
from collections.abc import Callable

from celery.exceptions import SoftTimeLimitExceeded

from farm.errors import (
    AssetError,
    DestinationError,
    FarmError,
    MachineError,
    RenderError,
    TemplateError,
    UnfitWorkerError,
)
from farm.run.worker_settings import RendererSettings
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from worker.service.picture import Picture, Renderer

log = logging.getLogger(__name__)

OpenRenderer = Callable[[DatasetHeader, RendererSettings], Renderer]
"""Opens the renderer of a dataset in the calling process. Raises FarmError if the template, an asset or the device is
not what it must be."""

_FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EROFS})
"""Errors of a disk that takes no more."""

_FAULTS_OF_THE_MACHINE = (AssetError, MachineError, TemplateError)


class KeptRenderer:
    """Makes pictures, with the renderer of the last dataset kept open.

    Args:
        open_renderer: function that opens the renderer of a dataset; called in this process, at its first job.
        settings: settings of the renderer.
    """

    def __init__(self, open_renderer: OpenRenderer, settings: RendererSettings) -> None:
        self._open_renderer = open_renderer
        self._settings = settings
        self._header: DatasetHeader | None = None
        self._renderer: Renderer | None = None

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Make one picture; see `worker.service.picture.Renderer`.

        Raises:
            UnfitWorkerError: if this machine can't open the renderer, or lacks what the scene shows.
            DestinationError: if a disk that the renderer needs is full, or can't be written.
            FarmError: another failure that the renderer foresees.
            RenderError: if the renderer failed in an unforeseen way, or took longer than the time limit.
        """
        renderer = self._renderer_for(header)
        try:
            return renderer.make(job, header)
        except _FAULTS_OF_THE_MACHINE as error:
            # Textures and HDRIs are looked up when a scene first shows them.
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except FarmError:
            raise
        except SoftTimeLimitExceeded as error:
            raise RenderError("took longer than the time limit") from error
        except Exception as error:
            if (fault := _fault_of_a_disk(error)) is not None:
                raise fault from error
            raise defect(job, error) from error

    def _renderer_for(self, header: DatasetHeader) -> Renderer:
        if self._renderer is None or self._header != header:
            self._renderer = None  # two open templates at once would need twice the memory
            self._renderer = self._opened(header)
            self._header = header
        return self._renderer

    def _opened(self, header: DatasetHeader) -> Renderer:
        try:
            return self._open_renderer(header, self._settings)
        except FarmError as error:
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except SoftTimeLimitExceeded as error:
            raise RenderError("opening the template took longer than the time limit") from error
        except Exception as error:
            if (fault := _fault_of_a_disk(error)) is not None:
                raise fault from error
            # Blender's libraries, the driver or the memory failed, not the job.
            log.exception("nothing can be rendered here")
            reason = f"can't open Blender: {type(error).__name__}: {error}"
            raise UnfitWorkerError(reason, MachineError.exit_code) from error


def _fault_of_a_disk(error: Exception) -> DestinationError | None:
    """The fault of a disk of this machine that is full or not writable: the worker waits, as for a full store."""
    if not isinstance(error, OSError) or error.errno not in _FULL:
        return None
    place = error.filename or f"a file of this machine, in {os.environ.get('TMPDIR', '/tmp')} or a cache folder"  # noqa: S108 - named only
    return DestinationError(
        f"{place}: can't write: {error.strerror}; make room, or name other folders by TMPDIR and XDG_CACHE_HOME"
    )


def defect(job: Job, error: Exception) -> RenderError:
    """Turn an unforeseen error into one that is tried again, so that it ends in quarantine, not as a lost message."""
    log.error("%s: unexpected error", job.id, exc_info=error)
    return RenderError(f"unexpected {type(error).__name__}: {error}")
