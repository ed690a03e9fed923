"""A private S3 server for tests: OpenStack Swift with one disk, a folder, behind its S3 interface, on 127.0.0.1.

Swift comes with Debian and runs on Debian's own Python, so nothing of it is imported here: there is one process for
each of its four servers, and a short program that lays out its rings, the tables of which server holds what.
"""

import getpass
import os
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import s3fs

from farm.local.processes import stop
from farm.local.tied import tied

_START_S = 60.0
_STORES = ("account", "container", "object")
_DEBIAN_PYTHON = "/usr/bin/python3"

# One replica on one device, with 2 ** 4 partitions, each of which is a folder.
_RINGS = """
import sys
from swift.common.ring import RingBuilder
for pair in sys.argv[2:]:
    kind, port = pair.split("=")
    builder = RingBuilder(4, 1, 1)
    builder.add_dev({"region": 1, "zone": 1, "ip": "127.0.0.1", "port": int(port), "device": "disk", "weight": 1.0})
    builder.rebalance(seed=1)
    builder.get_ring().save("%s/%s.ring.gz" % (sys.argv[1], kind))
"""

# Eventlet, on which Swift runs, ends an answer to HEAD without a length as if it had a body, against the rules of
# HTTP. The proxy in front of a real Swift tolerates that; aiohttp doesn't.
_HEAD_FILTER = """
def make_filter(global_conf, **local_conf):
    def wrap(app):
        def answer(environ, start_response):
            def start(status, headers, exc_info=None):
                names = {name.lower() for name, _ in headers}
                if environ["REQUEST_METHOD"] == "HEAD" and "content-length" not in names:
                    headers = [*headers, ("Content-Length", "0")]
                return start_response(status, headers, exc_info)
            return app(environ, start)
        return answer
    return wrap
"""

# Listings come in short pages, so that tests see more than one. They must hold an object as soon as its put has ended,
# however busy the machine is, so the object's server waits for the container's. A cache would make them lag; the proxy
# insists on one, so it is given an address at which nothing listens.
_STORE_CONFIG = """
[DEFAULT]
bind_ip = 127.0.0.1
bind_port = {port}
user = {user}
swift_dir = {folder}
devices = {folder}/devices
mount_check = false
disable_fallocate = true
workers = 0
recon_cache_path = {folder}/recon
container_update_timeout = 60
node_timeout = 60
conn_timeout = 10

[pipeline:main]
pipeline = {kind}-server

[app:{kind}-server]
use = egg:swift#{kind}
"""

_PROXY_CONFIG = """
[DEFAULT]
bind_ip = 127.0.0.1
bind_port = {port}
user = {user}
swift_dir = {folder}
workers = 0

[pipeline:main]
pipeline = head catch_errors gatekeeper healthcheck cache listing_formats s3api tempauth bulk slo proxy-server

[filter:head]
paste.filter_factory = head_filter:make_filter

[filter:catch_errors]
use = egg:swift#catch_errors

[filter:gatekeeper]
use = egg:swift#gatekeeper

[filter:healthcheck]
use = egg:swift#healthcheck

[filter:cache]
use = egg:swift#memcache
memcache_servers = 127.0.0.1:1

[filter:listing_formats]
use = egg:swift#listing_formats

[filter:s3api]
use = egg:swift#s3api
max_bucket_listing = 20

[filter:tempauth]
use = egg:swift#tempauth
user_farm_tester = {secret} .admin

[filter:bulk]
use = egg:swift#bulk

[filter:slo]
use = egg:swift#slo

[app:proxy-server]
use = egg:swift#proxy
account_autocreate = true
node_timeout = 60
conn_timeout = 10
recoverable_node_timeout = 60
error_suppression_limit = 1000000
"""


class ObjectStore:
    """A running server.

    Attributes:
        endpoint: URL of the server.
        key: id of the access key.
        secret: the secret access key.
        port: port of the proxy, the server that clients talk to.
    """

    key = "farm:tester"
    secret = "a-secret-of-these-tests"  # noqa: S105 - of a server that nobody else can reach

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._ports = dict(zip((*_STORES, "proxy"), _free_ports(len(_STORES) + 1), strict=True))
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self.port = self._ports["proxy"]
        self.endpoint = f"http://127.0.0.1:{self.port}"

    def start(self) -> None:
        """Write rings and configurations, start all servers, and wait until they answer.

        Raises:
            RuntimeError: if one doesn't answer.
        """
        (self._folder / "devices/disk").mkdir(parents=True)
        (self._folder / "recon").mkdir()
        (self._folder / "head_filter.py").write_text(_HEAD_FILTER)
        pairs = [f"{kind}={self._ports[kind]}" for kind in _STORES]
        subprocess.run([_DEBIAN_PYTHON, "-c", _RINGS, str(self._folder), *pairs], check=True)
        for kind, port in self._ports.items():
            template = _PROXY_CONFIG if kind == "proxy" else _STORE_CONFIG
            values = {"folder": self._folder, "kind": kind, "port": port, "user": getpass.getuser()}
            config = template.format(**values, secret=self.secret)
            (self._folder / f"{kind}.conf").write_text(config)
            self._start_server(kind)
        for kind in self._ports:
            self._wait(kind)

    def environment(self) -> dict[str, str]:
        """The environment variables with which S3 clients find this server, and no other account of this machine."""
        return {
            "AWS_ENDPOINT_URL": self.endpoint,
            "AWS_ACCESS_KEY_ID": self.key,
            "AWS_SECRET_ACCESS_KEY": self.secret,
            "AWS_CONFIG_FILE": os.devnull,
            "AWS_SHARED_CREDENTIALS_FILE": os.devnull,
            "AWS_EC2_METADATA_DISABLED": "true",
        }

    def client(self) -> Any:
        """A client for actions that the farm never takes, such as making a bucket."""
        return s3fs.S3FileSystem(
            endpoint_url=self.endpoint,
            key=self.key,
            secret=self.secret,
            use_listings_cache=False,
            skip_instance_cache=True,
        )

    def kill(self, kind: str = "proxy") -> None:
        """Kill one of the servers with SIGKILL: `object`, or `proxy`, to which clients talk."""
        process = self._processes.pop(kind)
        process.kill()
        process.wait()

    def revive(self, kind: str = "proxy") -> None:
        """Start a killed server again, on the same port.

        Raises:
            RuntimeError: if it doesn't answer.
        """
        self._start_server(kind)
        self._wait(kind)

    def stop(self) -> None:
        """End every process."""
        stop(list(self._processes.values()), grace_s=1.0)

    def _start_server(self, kind: str) -> None:
        paths = [str(self._folder), *filter(None, [os.environ.get("PYTHONPATH")])]
        with (self._folder / f"{kind}.log").open("ab") as log:
            self._processes[kind] = subprocess.Popen(
                tied([_program(kind), str(self._folder / f"{kind}.conf"), "--verbose"]),
                env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )

    def _wait(self, kind: str) -> None:
        # A store's own server has no page to look at, so a refusal is answer enough.
        url = f"http://127.0.0.1:{self._ports[kind]}/healthcheck"
        give_up_s = time.monotonic() + _START_S
        while True:
            try:
                urllib.request.urlopen(url, timeout=5).close()
                return
            except urllib.error.HTTPError:
                return
            except OSError:
                if self._processes[kind].poll() is None and time.monotonic() < give_up_s:
                    time.sleep(0.05)
                    continue
                log = (self._folder / f"{kind}.log").read_text(errors="replace")
                raise RuntimeError(f"Swift's {kind} server did not start:\n{log[-2000:]}") from None


def has_object_store() -> bool:
    """Whether Swift's programs are installed."""
    return os.access(_DEBIAN_PYTHON, os.X_OK) and all(shutil.which(_program(kind)) for kind in (*_STORES, "proxy"))


@contextmanager
def private_object_store() -> Iterator[ObjectStore]:
    """Run a server within the context.

    Raises:
        RuntimeError: if it doesn't start.
    """
    with tempfile.TemporaryDirectory(prefix="farm-s3-") as folder:
        store = ObjectStore(Path(folder))
        try:
            store.start()
            yield store
        finally:
            store.stop()


def _program(kind: str) -> str:
    return f"swift-{kind}-server"


def _free_ports(count: int) -> list[int]:
    sockets = [socket.socket() for _ in range(count)]
    try:
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()
