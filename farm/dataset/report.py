"""`report.html`: the pictures with their masks beside them, and what they cost. One file, no scripts."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template
from urllib.parse import quote

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.index import IndexEntry, index_lines, read_line, write_index_of
from farm.dataset.memory import Memory
from farm.dataset.outputs import IMAGE, MASK
from farm.dataset.paths import REPORT_FILE
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet

_UNKNOWN = "-"


@dataclass(slots=True)
class _Section:
    """The page's section on one category; only the first pictures are shown.

    Attributes:
        quota: number of images asked for.
        done: number of images that are done.
        means_s: mean seconds of each stage.
        shown: entries of the images that are shown.
    """

    quota: int
    done: int
    means_s: Mapping[str, float]
    shown: list[IndexEntry]


def write_report(dataset: Dataset, *, pictures_per_category: int = 40) -> int:
    """Write the page.

    Args:
        dataset: the dataset, done or in the making.
        pictures_per_category: maximum number of pictures that are shown of each category.

    Returns:
        Number of images that are done.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    completion = Completion(dataset)
    done = completion.audit()
    shown = _Shown(pictures_per_category)
    for job, line in index_lines(dataset, completion, filter(shown.wants, done.by_category())):
        shown.add(job, line)
    _write_page(dataset, done, completion.memory, shown)
    return len(done)


def write_overview(dataset: Dataset, *, pictures_per_category: int = 40) -> int:
    """Write the index and the page in one pass, at the end of a dataset's making, whether it succeeded or not.

    Args:
        dataset: the dataset.
        pictures_per_category: maximum number of pictures that the page shows of each category.

    Returns:
        Number of images that are done.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    completion = Completion(dataset)
    completion.audit()
    shown = _Shown(pictures_per_category)
    listed = write_index_of(dataset, completion, shown.add)
    _write_page(dataset, listed, completion.memory, shown)
    return len(listed)


class _Shown:
    """The entries of the first pictures of each category."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._wanted: Counter[Category] = Counter()
        self.entries: dict[Category, list[IndexEntry]] = defaultdict(list)

    def wants(self, job: Job) -> bool:
        """Whether a job is one of the first of its category; each job may be asked about once, in order."""
        self._wanted[job.category] += 1
        return self._wanted[job.category] <= self._most

    def add(self, job: Job, line: bytes) -> None:
        """Take the line of a done job, if it is to be shown."""
        if len(self.entries[job.category]) < self._most:
            self.entries[job.category].append(read_line(line))


def _write_page(dataset: Dataset, done: JobSet, memory: Memory, shown: _Shown) -> None:
    counts, members = done.counts(), done.members()
    sections = {
        category: _Section(
            quota, counts[category], memory.means_s(category, members[category]), shown.entries[category]
        )
        for category, quota in dataset.header.spec.quotas.items()
        if quota
    }
    dataset.storage.write(REPORT_FILE, _page(dataset, sections).encode())


def _page(dataset: Dataset, sections: Mapping[Category, _Section]) -> str:
    spec = dataset.header.spec
    facts = {
        "images": f"{sum(section.done for section in sections.values())} of {spec.total}",
        "seed": str(spec.seed),
        "size": f"{spec.resolution.width} x {spec.resolution.height} px",
        "engine": f"{spec.engine}, {spec.quality}",
        "surfaces": str(len(dataset.header.surfaces)),
        "HDRIs": str(len(dataset.header.hdris)),
        "description": dataset.identity[:12],
    }
    template = Template((files("farm.dataset") / "report_template.html").read_text(encoding="utf-8"))
    return template.substitute(
        title=escape(dataset.name),
        shape=f"{spec.resolution.width} / {spec.resolution.height}",
        facts="".join(f"<div><dt>{escape(name)}</dt><dd>{escape(value)}</dd></div>" for name, value in facts.items()),
        table=_table(sections),
        navigation=" ".join(f'<a href="#{category}">{escape(_words(category))}</a>' for category in sections),
        sections="".join(_section(category, section) for category, section in sections.items()),
    )


def _table(sections: Mapping[Category, _Section]) -> str:
    stages = list(dict.fromkeys(stage for section in sections.values() for stage in section.means_s))
    head = "".join(f"<th>{escape(name)}</th>" for name in ["category", "done", "quota", *stages, "sum"])
    body = "".join(_rows(sections, stages))
    caption = "Mean seconds per image and stage"
    return f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _rows(sections: Mapping[Category, _Section], stages: list[str]) -> Iterable[str]:
    for category, section in sections.items():
        means = [section.means_s.get(stage) for stage in stages]
        known = [mean for mean in means if mean is not None]
        cells = [_words(category), str(section.done), str(section.quota)]
        cells += [_UNKNOWN if mean is None else f"{mean:.2f}" for mean in means]
        cells.append(f"{sum(known):.2f}" if known else _UNKNOWN)
        yield "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _section(category: Category, section: _Section) -> str:
    count = f"{section.done} of {section.quota}"
    if len(section.shown) < section.done:
        count += f", the first {len(section.shown)} shown"
    cards = "".join(_card(entry) for entry in section.shown)
    return (
        f'<section id="{category}"><h2>{escape(_words(category))} <small>{escape(count)}</small></h2>'
        f'<div class="grid">{cards}</div></section>'
    )


def _card(entry: IndexEntry) -> str:
    pictures = "".join(
        f'<a href="{quote(path)}"><img src="{quote(path)}" alt="{role} of {escape(entry.job_id)}" loading="lazy"></a>'
        for role, path in ((output.role, entry.files[output.role].path) for output in (IMAGE, MASK))
    )
    facts = [f"{entry.cables} cable{'s' if entry.cables != 1 else ''}", f"{entry.camera_height_m * 100:.0f} cm high"]
    facts += [str(fact) for fact in (entry.surface, entry.hdri, entry.lamp and f"{entry.lamp} lamp") if fact]
    facts += [f"seed {entry.seed}"] + ([f"draw {entry.attempt + 1}"] if entry.attempt else [])
    chips = "".join(f"<li>{escape(fact)}</li>" for fact in facts)
    return (
        f'<figure><div class="pair">{pictures}</div><figcaption><b>{escape(entry.job_id)}</b>'
        f"<span>{escape(_words(entry.category))}</span><ul>{chips}</ul></figcaption></figure>"
    )


def _words(category: Category) -> str:
    return category.replace("_", " ")
