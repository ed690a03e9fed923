"""Train and test a network on the CPU, with the same result every time on the same machine."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from benchmarks.training.augmentation import as_input, augment
from benchmarks.training.examples import Examples

BATCH = 8
"""Pictures in a training step."""
_PEAK_RATE = 3e-3
"""Highest learning rate of the cycle."""
_WEIGHT_DECAY = 1e-4
"""AdamW's weight decay."""
_WARM_UP = 0.15
"""Share of all steps during which the learning rate rises."""


@contextmanager
def deterministic() -> Iterator[None]:
    """Restrict PyTorch, within the context, to algorithms whose result is the same in every call."""
    before = torch.are_deterministic_algorithms_enabled()
    torch.use_deterministic_algorithms(True)
    try:
        yield
    finally:
        torch.use_deterministic_algorithms(before)


def train(
    network: nn.Module,
    examples: Examples,
    epochs: int,
    draw: np.random.Generator,
    tell: Callable[[int, float], None] = lambda _number, _loss: None,
) -> list[float]:
    """Train a network in place with AdamW, one cycle of the learning rate, and `segmentation_loss`.

    Args:
        network: network from pictures (N, 3, H, W) to logits (N, 1, H, W).
        examples: the training set.
        epochs: number of passes over the training set.
        draw: source of the randomness, for the order and the augmentation.
        tell: function called after each epoch with its number, counted from 1, and its mean loss.

    Returns:
        The mean loss of each epoch.
    """
    steps = epochs * -(-len(examples) // BATCH)
    network.train()
    optimizer = torch.optim.AdamW(network.parameters(), lr=_PEAK_RATE, weight_decay=_WEIGHT_DECAY)
    rate = torch.optim.lr_scheduler.OneCycleLR(optimizer, _PEAK_RATE, total_steps=steps, pct_start=_WARM_UP)
    means: list[float] = []
    for number in range(1, epochs + 1):
        losses = []
        for pictures, masks in _batches(examples, draw):
            optimizer.zero_grad()
            loss = segmentation_loss(network(pictures), masks)
            torch.autograd.backward(loss)
            optimizer.step()
            rate.step()
            losses.append(float(loss.detach()))
        means.append(float(np.mean(losses)))
        tell(number, means[-1])
    return means


def predict(network: nn.Module, pictures: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """The masks (N, H, W) that a network predicts for pictures (N, H, W, 3)."""
    network.eval()
    found = []
    with torch.inference_mode():
        for start in range(0, len(pictures), BATCH):
            inputs = np.stack([as_input(each.astype(np.float32) / 255.0) for each in pictures[start : start + BATCH]])
            found.append((network(_laid_out(inputs))[:, 0] > 0).numpy())
    masks: NDArray[np.bool_] = np.concatenate(found)
    return masks


def segmentation_loss(logits: Tensor, masks: Tensor) -> Tensor:
    """Mean binary cross-entropy, plus one minus the batch's soft Dice, since cables cover few of the pixels.

    Args:
        logits: logits of the network, (N, 1, H, W).
        masks: true masks of 0 and 1, (N, 1, H, W).
    """
    seen = torch.sigmoid(logits)
    dice = (2.0 * (seen * masks).sum() + 1.0) / (seen.sum() + masks.sum() + 1.0)
    loss: Tensor = functional.binary_cross_entropy_with_logits(logits, masks) + 1.0 - dice
    return loss


def _batches(examples: Examples, draw: np.random.Generator) -> Iterator[tuple[Tensor, Tensor]]:
    """Batches of all examples in a new random order; the last batch may be smaller."""
    order = draw.permutation(len(examples))
    for start in range(0, len(order), BATCH):
        chosen = order[start : start + BATCH]
        changed = [augment(examples.pictures[index], examples.masks[index], draw) for index in chosen]
        pictures, masks = (np.stack(part) for part in zip(*changed, strict=True))
        yield _laid_out(pictures), torch.from_numpy(masks)


def _laid_out(pictures: NDArray[np.float32]) -> Tensor:
    """Make a tensor with channels last in memory, with which a step on a CPU takes half the time."""
    return torch.from_numpy(pictures).contiguous(memory_format=torch.channels_last)
