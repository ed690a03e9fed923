import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.chaos.hang import HangingStore, compile_library, join_environments

CALLS = [
    "os.stat(store + '/file')",
    "os.lstat(store + '/file')",
    "os.statvfs(store)",
    "os.listdir(store)",
    "list(os.scandir(store))",
    "open(store + '/file').read()",
    "open(store + '/new', 'w').close()",
    "os.mkdir(store + '/folder')",
    "os.replace(store + '/one', store + '/other')",
    "os.unlink(store + '/two')",
    "os.fsync(kept.fileno())",
]

PROGRAM = """
import os, sys, threading
store, elsewhere, *calls = sys.argv[1:]
kept = open(store + '/kept', 'w')
print('ready', flush=True)
input()
threads = {call: threading.Thread(target=eval, args=(call, globals()), daemon=True) for call in calls}
for thread in threads.values():
    thread.start()
os.stat(elsewhere); os.statvfs(elsewhere); os.listdir(elsewhere)
for thread in threads.values():
    thread.join(0.03)
print(*(call for call, thread in threads.items() if not thread.is_alive()), 'went on', flush=True)
for thread in threads.values():
    thread.join()
print('all went on', flush=True)
"""


@pytest.fixture
def store(tmp_path: Path) -> HangingStore:
    """A store with a file."""
    (tmp_path / "store").mkdir()
    for name in ("file", "one", "two"):
        (tmp_path / "store" / name).write_text("")
    library = compile_library(tmp_path)
    if isinstance(library, str):
        pytest.skip(library)
    return HangingStore(library, tmp_path / "store", tmp_path / "flag")


def test_calls_hang_for_a_while(store: HangingStore, tmp_path: Path) -> None:
    """Each call on the store waits until the store answers, while calls on other folders go on."""
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(tmp_path / "store"), str(tmp_path), *CALLS],
        env={**os.environ, **store.environment()},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        store.hang()
        process.stdin.write("go\n")
        process.stdin.flush()
        assert process.stdout.readline() == "went on\n"
        store.answer()
        assert process.stdout.readline() == "all went on\n"
    assert process.returncode == 0


def test_libraries_add_up() -> None:
    """Two environments that preload a library each preload both."""
    joined = join_environments({"LD_PRELOAD": "/a.so", "A": "1"}, {}, {"LD_PRELOAD": "/b.so", "B": "2"})
    assert joined == {"LD_PRELOAD": "/a.so:/b.so", "A": "1", "B": "2"}
    assert join_environments({"A": "1"}) == {"A": "1"}
