import json
from pathlib import Path

from farm.storage import LocalStorage
from tests.chaos.files import exchange_for_a_file
from tests.chaos.manifest_watch import ManifestWatch, fingerprint


def _manifest(**content: object) -> bytes:
    return json.dumps({"job_id": "far-000000", "timings_s": {"render": 1.0}, **content}).encode()


def test_timings_do_not_count() -> None:
    """Two manifests of one picture, made twice, have one fingerprint."""
    assert fingerprint(_manifest(seed=1, timings_s={"render": 2.0})) == fingerprint(_manifest(seed=1))


def test_all_else_counts() -> None:
    """Manifests that differ in anything but timings have different fingerprints."""
    assert fingerprint(_manifest(seed=1)) != fingerprint(_manifest(seed=2))


def test_damage_has_a_fingerprint() -> None:
    """Different damaged manifests have different fingerprints."""
    assert len({fingerprint(content) for content in (b"", b"[]", b"{", _manifest())}) == 4


def test_replaced_at_once(tmp_path: Path) -> None:
    """Manifests in quick succession are all seen, and those that contradict each other are reported."""
    storage = LocalStorage(tmp_path)
    with ManifestWatch([tmp_path / "manifests"]) as watch:
        for seed in (1, 1, 2):
            storage.write("manifests/far-000000.json", _manifest(seed=seed))
        storage.write("manifests/far-000001.json", _manifest())
    assert watch.seen() == ["far-000000", "far-000001"]
    assert watch.again == 2
    assert watch.contradictions() == ["far-000000"]


def test_folder_moved_away(tmp_path: Path) -> None:
    """A folder that was away for a while is still watched, and holds its files."""
    storage = LocalStorage(tmp_path / "cables")
    with ManifestWatch([tmp_path / "cables/far/manifests"]) as watch:
        storage.write("far/manifests/far-000000.json", _manifest())
        put_back = exchange_for_a_file(tmp_path / "cables/far")
        assert (tmp_path / "cables/far").is_file()
        put_back()
        storage.write("far/manifests/far-000001.json", _manifest())
    assert watch.seen() == ["far-000000", "far-000001"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cables"]
