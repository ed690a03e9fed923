"""Training learns, repeats, and writes its results. Needs PyTorch, which is an extra."""

import argparse
import json
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from benchmarks.pictures.making import NamedDataset
from benchmarks.training.command import run
from benchmarks.training.examples import Examples
from benchmarks.training.options import add_training, training_plan_of
from benchmarks.training.outcome import Lesson
from benchmarks.training.plan import PHOTOGRAPHS, Plan
from benchmarks.training.plot import overlay
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.errors import MachineError, SpecError
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

EDGE = 32


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    """Use one thread: it is fast enough for tiny pictures, and two would wait for each other beside other tests."""
    if find_spec("torch") is None:
        yield
        return
    import torch  # noqa: PLC0415  # an extra

    before = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(before)


def bright_bars(pictures: int) -> Examples:
    """Noise with a brighter bar, which is the cable."""
    draw = np.random.default_rng(7)
    levels = draw.integers(0, 100, (pictures, EDGE, EDGE, 3), dtype=np.uint8)
    masks = np.zeros((pictures, EDGE, EDGE), np.bool_)
    for mask in masks:
        top = int(draw.integers(2, EDGE - 8))
        mask[top : top + 5] = True
    levels[masks] += 150
    return Examples(levels, masks)


def learn(epochs: int) -> tuple[list[float], bytes, float]:
    """Train a small network; returns the losses, the predicted masks, and the IoU."""
    torch = pytest.importorskip("torch")
    from benchmarks.training.lessons import deterministic, predict, train  # noqa: PLC0415
    from benchmarks.training.network import UNet  # noqa: PLC0415

    examples = bright_bars(8)
    network = UNet(torch.Generator().manual_seed(1), widths=(4, 8))
    with deterministic():
        losses = train(network, examples, epochs, np.random.default_rng(2))
        seen = predict(network, examples.pictures)
    lesson = Lesson("bars", len(examples), losses, 0.0, {"bars": seen})
    return losses, seen.tobytes(), lesson.scores("bars", examples).mean_iou


def test_two_steps_lower_the_loss() -> None:
    """With a single batch an epoch is a step, so the second loss is that after the first step."""
    losses, _, _ = learn(3)
    assert len(losses) == 3
    assert losses[2] < losses[0]


def test_a_bright_bar_is_learned() -> None:
    """Thirty steps find the bar; calling everything cable would have an IoU of 0.16."""
    assert learn(30)[2] > 0.5


def test_training_repeats() -> None:
    """Losses and masks repeat to the last bit."""
    assert learn(4) == learn(4)


def test_networks_begin_alike() -> None:
    """The generator alone decides the weights; another seed gives others."""
    torch = pytest.importorskip("torch")
    from benchmarks.training.network import UNet  # noqa: PLC0415

    weights = [
        torch.cat([part.flatten() for part in UNet(torch.Generator().manual_seed(seed)).state_dict().values()])
        for seed in (5, 5, 6)
    ]
    assert torch.equal(weights[0], weights[1])
    assert not torch.equal(weights[0], weights[2])


def test_the_network_is_small() -> None:
    """The network has half a million to a million weights, and its logits have the pictures' size."""
    torch = pytest.importorskip("torch")
    from benchmarks.training.network import UNet  # noqa: PLC0415

    network = UNet(torch.Generator().manual_seed(0))
    assert 5e5 <= sum(part.numel() for part in network.parameters()) <= 1e6
    assert network(torch.zeros(2, 3, 64, 48)).shape == (2, 1, 64, 48)


@pytest.fixture
def noise(tmp_path: Path) -> Dataset:
    """Two pictures of noise."""
    dataset = create_dataset(Destination(str(tmp_path / "store"), "noise"), stand_in_header(far=2))
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def test_a_run_writes_every_score(noise: Dataset, tmp_path: Path) -> None:
    """Two networks are tested on two sets and on photographs; trained on the same pictures, they score the same."""
    pytest.importorskip("torch")
    for part, image in (("images", np.full((300, 400, 3), 90, np.uint8)), ("masks", np.zeros((300, 400), np.uint8))):
        (tmp_path / "mine" / part).mkdir(parents=True)
        Image.fromarray(image).save(tmp_path / "mine" / part / "one.png")
    named = tuple(NamedDataset(name, noise.storage.location) for name in ("one", "two"))
    plan = Plan(seed=0, images=1, test_images=1, epochs=1, train=named, test=named, photographs=tmp_path / "mine")
    assert run(tmp_path, plan) == 0
    content = json.loads((tmp_path / "training.json").read_text())
    first, second = content["networks"]
    assert (first["trained_on"], second["trained_on"]) == ("one", "two")
    assert list(first["tested_on"]) == ["one", "two", PHOTOGRAPHS]
    assert first["tested_on"][PHOTOGRAPHS]["pictures"] == 1
    assert first["tested_on"] == second["tested_on"]
    assert 0 <= first["tested_on"]["one"]["mean_iou"] <= first["tested_on"]["one"]["mean_dice"] <= 1
    assert Image.open(tmp_path / "training.png").size[0] > 500


def test_without_pytorch_it_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error names PyTorch before any picture is made."""
    monkeypatch.setattr("benchmarks.training.command.find_spec", lambda _: None)
    with pytest.raises(MachineError, match=r"cable-farm\[train\]"):
        run(tmp_path, Plan(seed=0, images=1, test_images=1, epochs=1))


@pytest.mark.parametrize(
    "plan",
    [
        Plan(seed=0, images=0, test_images=1, epochs=1),
        Plan(seed=0, images=1, test_images=1, epochs=0),
        Plan(seed=0, images=1, test_images=1, epochs=1, train=(NamedDataset("a", "x"), NamedDataset("a", "y"))),
        Plan(seed=0, images=1, test_images=1, epochs=1, test=(NamedDataset(PHOTOGRAPHS, "x"),)),
    ],
)
def test_what_can_not_be_done_is_refused(plan: Plan, tmp_path: Path) -> None:
    """No pictures, no epochs, and one name for two sets are refused."""
    with pytest.raises(SpecError):
        run(tmp_path, plan)


def test_options_become_a_plan() -> None:
    """Each option ends up in its field of the plan."""
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument("--seed", type=int, default=0)
    parser = argparse.ArgumentParser()
    add_training(parser.add_subparsers(), shared)
    arguments = "training --seed 3 --images 5 --test-images 4 --epochs 2 --train a=x --test b=y --extra-test z"
    assert training_plan_of(parser.parse_args(arguments.split())) == Plan(
        seed=3,
        images=5,
        test_images=4,
        epochs=2,
        train=(NamedDataset("a", "x"),),
        test=(NamedDataset("b", "y"),),
        photographs=Path("z"),
    )


def test_an_overlay_tells_hits_from_errors() -> None:
    """Hits are white, false alarms red, misses blue, and the rest black."""
    seen, true = np.array([[True, True, False, False]]), np.array([[True, False, True, False]])
    hit, false_alarm, miss, nothing = overlay(seen, true)[0]
    assert hit.min() == 255
    assert false_alarm.argmax() == 0
    assert miss.argmax() == 2
    assert nothing.max() == 0
