"""Tells how a dataset's header differs from the one that a user asks for."""

import json
from collections.abc import Mapping

from farm.dataset.earlier_forms import in_todays_form
from farm.dataset.header_file import WrittenHeader
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, FolderSurfaceRef
from farm.spec.styles import RANGES_OF


def difference(present: WrittenHeader, asked: DatasetHeader) -> str:
    """Find the first thing in which a dataset is not what is asked, as `key is 1, asked 2`; empty if there is none.

    The user's files count by content, not by path or name: a texture may be named after its folder. Where another
    release wrote the header, only what a user decides counts: what that release resolved otherwise, such as built-in
    surfaces or samples, stays as it is written.
    """
    if present.header.farm_version == asked.farm_version:
        return first_difference(_without_places(present.header), _without_places(asked))
    spec = asked.spec.model_dump(mode="json")
    written = in_todays_form(present.written)["spec"]
    style = {"ranges": RANGES_OF[asked.spec.style].model_dump(mode="json")}
    decided = _decided(present.header.spec.model_dump(mode="json"), written, spec, style)
    return first_difference({"spec": decided}, {"spec": spec}, added=False) or (
        first_difference(_files_of_user(present.header), _files_of_user(asked))
    )


def _decided(parsed: object, written: object, asked: object, style: object) -> object:
    """Leave out the keys that the file does not hold: its release did not know them, so no user decided them.

    Such a key stays if it is asked for with another value than this release's default and the style's.
    """
    if not (isinstance(parsed, Mapping) and isinstance(written, Mapping) and isinstance(asked, Mapping)):
        return parsed
    of_style = style if isinstance(style, Mapping) else {}
    kept: dict[str, object] = {}
    for key, value in parsed.items():
        if key in written:
            kept[key] = _decided(value, written[key], asked.get(key), of_style.get(key))
        elif asked.get(key) not in (value, of_style.get(key)):
            kept[key] = value
    return kept


def _without_places(header: DatasetHeader) -> dict[str, object]:
    """The header as JSON, without the paths and names of the user's files."""
    values = header.model_dump(mode="json", exclude={"farm_version"})
    values["template"].pop("path")
    for entry in (*values["surfaces"], *values["hdris"], *values["plates"]):
        if entry.pop("path", None) is not None or "files" in entry:
            del entry["name"]
        for file in entry.get("files", {}).values():
            del file["path"]
    for key in ("surfaces", "hdris", "plates"):
        values[key].sort(key=_own_first)
    return values


def _own_first(entry: Mapping[str, object]) -> str:
    """Sort the user's files, which lost their names, by content, and leave the built-in ones in their order."""
    return "" if "name" in entry else json.dumps(entry, sort_keys=True)


def _files_of_user(header: DatasetHeader) -> dict[str, object]:
    """The files that a user named, by content, and whether built-in ones take part."""
    surfaces = [surface for surface in header.surfaces if isinstance(surface, FolderSurfaceRef)]
    return {
        "template": None if header.template.path is None else header.template.sha256,
        "textures": sorted(sorted((role, file.sha256) for role, file in entry.files.items()) for entry in surfaces),
        "hdris": sorted(hdri.sha256 for hdri in header.hdris if hdri.path is not None and hdri.sha256 is not None),
        "backgrounds": sorted(plate.sha256 for plate in header.plates),
        "builtin_textures": any(isinstance(surface, BuiltinSurfaceRef) for surface in header.surfaces),
        "builtin_hdris": any(hdri.path is None and hdri.sha256 is not None for hdri in header.hdris),
        "environments": any(hdri.recipe_version is not None for hdri in header.hdris),
    }


def first_difference(present: object, asked: object, where: str = "", *, added: bool = True) -> str:
    """Find the first key in which two JSON values differ, as `key is 1, asked 2`; empty if they are equal.

    Args:
        present: the one value.
        asked: the other.
        where: path of keys to the two.
        added: whether a key that only `asked` has is a difference.
    """
    if isinstance(present, Mapping) and isinstance(asked, Mapping):
        for key in [*present, *(key for key in asked if added and key not in present)]:
            path = f"{where}.{key}" if where else str(key)
            if found := first_difference(present.get(key), asked.get(key), path, added=added):
                return found
        return ""
    if isinstance(present, list) and isinstance(asked, list):
        for index, (one, other) in enumerate(zip(present, asked, strict=False)):
            if found := first_difference(one, other, f"{where}[{index}]", added=added):
                return found
        if len(present) != len(asked):
            return f"{where} has {len(present)} entries, asked {len(asked)}"
        return ""
    return "" if present == asked else f"{where} is {_short(present)}, asked {_short(asked)}"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
