"""`python -X importtime -m benchmarks.startup.timeline SPAWNED_S RESULT`: a worker's start, up to two pictures.

It does in one process what a worker's main process and its child do in succession. It reads the header, a line break
and the job's identifier from stdin. It imports nothing outside the marks that time it.
"""

import sys
import time


def main(spawned_s: float, result: str) -> None:
    """Start, make a picture, make it again, and write the seconds of each step.

    Args:
        spawned_s: time of the system's monotonic clock just before this process was requested.
        result: path of the JSON file to write.
    """
    marks = [spawned_s, time.perf_counter()]
    import worker.cli  # noqa: PLC0415  # what the main process imports

    marks.append(time.perf_counter())
    import worker.blender.renderer  # noqa: PLC0415  # what the child imports

    marks.append(time.perf_counter())
    # The measurement's own imports come after those that it times, and their time is subtracted.
    from benchmarks.startup import watch  # noqa: PLC0415
    from farm.run.worker_settings import RendererSettings  # noqa: PLC0415

    header, job = watch.read_task(sys.stdin.read())
    pause_s = time.perf_counter() - marks[-1]
    settings, library = RendererSettings(), watch.TimedLibrary(header)
    renderer = worker.blender.renderer.BlenderRenderer(header, library, settings)
    marks.append(time.perf_counter())
    pictures = [watch.make(renderer, job, header, library) for _ in range(2)]
    watch.write(result, marks, pause_s, pictures)


if __name__ == "__main__":
    main(float(sys.argv[1]), sys.argv[2])
    from worker.service.exit import end_process

    end_process(0)
