"""The Celery application keeps to its own settings."""

import pytest

from farm.run.queue.settings import make_app


@pytest.fixture
def others(monkeypatch: pytest.MonkeyPatch) -> None:
    """Variables that another program's Celery reads."""
    for name in ("CELERY_BROKER_URL", "CELERY_BROKER_READ_URL", "CELERY_BROKER_WRITE_URL", "CELERY_RESULT_BACKEND"):
        monkeypatch.setenv(name, "redis://others:1/7")
    monkeypatch.setenv("CELERY_CONFIG_MODULE", "no_module_of_this_name")
    monkeypatch.setenv("CELERY_LOADER", "default")
    monkeypatch.setenv("DJANGO_SETTINGS_MODULE", "no_site_of_this_name.settings")


@pytest.mark.usefixtures("others")
def test_only_the_farms_own_broker_counts() -> None:
    """Sending and taking go to the farm's Redis, whatever variables another program has left."""
    app = make_app("redis://ours:6379/2")
    connections = (app.connection_for_read(), app.connection_for_write(), app.connection(), app.pool.connection)
    assert {(connection.hostname, connection.virtual_host) for connection in connections} == {("ours", "2")}


@pytest.mark.usefixtures("others", "recwarn")
def test_no_other_settings_are_read() -> None:
    """No module of settings, no loader and no site of another program is read, and there is no backend."""
    app = make_app("redis://ours:6379/2")
    assert app.conf.task_ignore_result
    assert type(app.backend).__name__ == "DisabledBackend"
    assert not app.fixups
