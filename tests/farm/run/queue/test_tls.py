"""Redis with a password over TLS: a real server, a real worker, and refusals."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from kombu.exceptions import OperationalError

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from farm.local.workers import LocalWorkers
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle
from farm.run.queue.broker import broker_url, connect
from farm.run.queue.settings import make_app
from farm.run.worker_settings import WorkerSettings
from tests.farm.run.queue.servers import ENCODED, PASSWORD, Certificates, debian_redis, free_port, make_certificates
from tests.farm.run.queue.servers import redis_server as run_redis


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> Certificates:
    """Certificates, made once, since they cost a tenth of a second each."""
    return make_certificates(tmp_path_factory.mktemp("certificates"))


@pytest.fixture(scope="module")
def place(certificates: Certificates, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """`HOST:PORT/NUMBER` of a Redis that speaks TLS alone and asks for a password."""
    port = free_port()
    arguments = ["--port", "0", "--tls-port", str(port), "--requirepass", PASSWORD, "--tls-auth-clients", "no"]
    arguments += ["--tls-cert-file", str(certificates.certificate), "--tls-key-file", str(certificates.key)]
    with run_redis(debian_redis(), tmp_path_factory.mktemp("redis"), port, arguments):
        yield f"127.0.0.1:{port}/0"


def assert_refused(url: str, reason: str) -> None:
    """Assert that no client is made, and the error is one line with the reason and without the password."""
    with pytest.raises(BrokerError, match=reason) as refused:
        connect(broker_url(url))
    assert "\n" not in str(refused.value)
    assert not re.search("secret|wrong-word", str(refused.value))


@pytest.mark.redis
def test_a_worker_does_its_jobs_over_tls_with_a_password(
    place: str, certificates: Certificates, dataset: Dataset, worker_command: list[str], tmp_path: Path
) -> None:
    """Queue, ledger and worker all use the one address."""
    url = broker_url(f"rediss://:{ENCODED}@{place}?ssl_ca_certs={certificates.authority}")
    client = connect(url)
    coordinator = Coordinator(dataset, open_handle(dataset, url, client), poll_s=0.1)
    assert coordinator.submit_missing() == 4
    settings = WorkerSettings(store=str(tmp_path / "store"), name="local", logs=tmp_path / "logs")
    with LocalWorkers(1, settings, url, worker_command) as workers:
        assert coordinator.watch(supervise=workers.supervise).done == 4
        log = workers.log_of("local-1").read_text()
    assert all(is_done(dataset, job) for job in dataset.header.spec.jobs())
    assert "insecure" not in log
    assert PASSWORD not in log
    assert ENCODED not in log


@pytest.mark.redis
def test_a_certificate_of_another_authority_is_refused(place: str, certificates: Certificates) -> None:
    """A server that can't show a certificate of the named authority is refused."""
    assert_refused(f"rediss://:{ENCODED}@{place}?ssl_ca_certs={certificates.stranger}", "certificate verify failed")


@pytest.mark.redis
def test_tls_without_options_checks_the_certificate(place: str) -> None:
    """A private authority is unknown to the system, so the bare address is refused."""
    assert_refused(f"rediss://:{ENCODED}@{place}", "certificate verify failed")


@pytest.mark.redis
def test_celery_checks_the_certificate_too(place: str) -> None:
    """Celery's default for `rediss://` checks nothing; with the farm's address it refuses."""
    app = make_app(broker_url(f"rediss://:{ENCODED}@{place}"))
    with app.connection() as connection, pytest.raises(OperationalError, match="certificate verify failed"):
        connection.ensure_connection(max_retries=1, interval_start=0)


@pytest.mark.redis
def test_a_certificate_for_another_host_is_refused(place: str, certificates: Certificates) -> None:
    """The certificate is for 127.0.0.1, so the same server under its name is refused."""
    url = f"rediss://:{ENCODED}@{place}?ssl_ca_certs={certificates.authority}".replace("127.0.0.1", "localhost")
    assert_refused(url, "certificate verify failed: Hostname mismatch")


@pytest.mark.redis
def test_a_wrong_password_is_refused(place: str, certificates: Certificates) -> None:
    """Redis refuses a wrong password, and the error doesn't show it."""
    url = f"rediss://:wrong-word@{place}?ssl_ca_certs={certificates.authority}"
    assert_refused(url, "invalid username-password pair")


@pytest.mark.redis
def test_an_address_without_tls_finds_no_redis(place: str) -> None:
    """An address without TLS is refused by a server that speaks TLS alone."""
    assert_refused(f"redis://:{ENCODED}@{place}", "no Redis at")


@pytest.mark.redis
def test_a_missing_authority_is_one_line(place: str) -> None:
    """A missing file of the authority gives one line."""
    assert_refused(f"rediss://:{ENCODED}@{place}?ssl_ca_certs=/nowhere.pem", "No such file")


@pytest.mark.parametrize(
    "query",
    [
        "ssl_cert_reqs=none",
        "ssl_cert_reqs=CERT_NONE",
        "ssl_cert_reqs=optional",
        "ssl_cert_reqs=",
        "ssl_cert_reqs=none&ssl_cert_reqs=required",
        "ssl_cert_reqs=required&ssl_cert_reqs=none",
        "ssl_cert_reqs=none&x=@",
        "ssl%5Fcert_reqs=none",
    ],
)
def test_no_address_switches_the_check_off(query: str) -> None:
    """No spelling of the address switches the check off."""
    with pytest.raises(BrokerError, match="without a check"):
        broker_url(f"rediss://:secret@there/0?{query}")


@pytest.mark.parametrize(
    ("url", "reason"),
    [
        ("rediss://there/0?ssl_check_hostname=false", "unknown option ssl_check_hostname"),
        ("rediss://there/0#", "%23"),
        ("redis://there/0?ssl_ca_certs=/a.pem", "write rediss://"),
    ],
)
def test_addresses_that_would_weaken_tls(url: str, reason: str) -> None:
    """Other ways to weaken the check, or TLS itself, are refused, and the error says what to write."""
    with pytest.raises(BrokerError, match=reason):
        broker_url(url)


@pytest.mark.parametrize(
    ("given", "used"),
    [
        ("rediss://there/0", "rediss://there/0?ssl_cert_reqs=required"),
        ("rediss://there/0?ssl_ca_certs=/a@b.pem", "rediss://there/0?ssl_ca_certs=/a@b.pem&ssl_cert_reqs=required"),
        ("rediss://there/0?ssl_cert_reqs=CERT_REQUIRED", "rediss://there/0?ssl_cert_reqs=required"),
    ],
)
def test_the_check_is_spelt_out(given: str, used: str) -> None:
    """The address spells out the check as Celery wants it, and spelling it out twice changes nothing."""
    assert broker_url(given) == used
    assert broker_url(used) == used


def test_the_address_comes_from_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The address may come from a file, where a container's secret is mounted; the environment's address wins."""
    (tmp_path / "url").write_text("redis://:secret@there/3\n")
    monkeypatch.delenv("FARM_BROKER_URL", raising=False)
    monkeypatch.setenv("FARM_BROKER_URL_FILE", str(tmp_path / "url"))
    assert broker_url(None) == "redis://:secret@there/3"
    monkeypatch.setenv("FARM_BROKER_URL", "redis://here/0")
    assert broker_url(None) == "redis://here/0"


@pytest.mark.parametrize("content", [None, b"\xff"])
def test_a_file_without_an_address_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: bytes | None
) -> None:
    """A file that is missing or isn't text is refused in one line with its name."""
    path = tmp_path / "url"
    if content is not None:
        path.write_bytes(content)
    monkeypatch.delenv("FARM_BROKER_URL", raising=False)
    monkeypatch.setenv("FARM_BROKER_URL_FILE", str(path))
    with pytest.raises(BrokerError, match=r"url: can't read the broker's address"):
        broker_url(None)
