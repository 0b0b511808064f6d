# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A small U-Net (Ronneberger et al. 2015) from scratch, its training and its answers."""
import time

import numpy as np
import torch
from torch import nn
from torch.nn import functional

import crops

CHANNELS = (8, 16, 32, 64)  # of each level; each has half the resolution of the one before
BATCH = 4
LEARNING_RATE = 3e-3  # at its highest
WEIGHT_DECAY = 1e-4
MEAN, DEVIATION = 110.0, 60.0  # grey levels, of the input
TORCH = torch.__version__
DEPTH = 2 ** (len(CHANNELS) - 1)  # sizes are multiples of it


def start(seed):
    """The same numbers for the same seed on the same machine: one thread, no GPU."""
    torch.set_num_threads(1)
    torch.use_deterministic_algorithms(True)
    torch.manual_seed(seed)


def block(inputs, outputs):
    layers = []
    for source in (inputs, outputs):
        layers += [nn.Conv2d(source, outputs, 3, padding=1, bias=False), nn.BatchNorm2d(outputs),
                   nn.ReLU(inplace=True)]
    return nn.Sequential(*layers)


class Network(nn.Module):
    def __init__(self):
        super().__init__()
        pairs = list(zip(CHANNELS, CHANNELS[1:]))
        self.down = nn.ModuleList([block(3, CHANNELS[0]), *(block(a, b) for a, b in pairs)])
        self.up = nn.ModuleList(block(a + b, a) for a, b in reversed(pairs))
        self.last = nn.Conv2d(CHANNELS[0], 1, 1)

    def forward(self, values):
        levels = []
        for number, part in enumerate(self.down):
            values = part(functional.max_pool2d(values, 2) if number else values)
            levels.append(values)
        for part, level in zip(self.up, reversed(levels[:-1])):
            wide = functional.interpolate(values, scale_factor=2, mode="nearest")
            values = part(torch.cat([wide, level], dim=1))
        return self.last(values)[:, 0]


def tensor(images):
    """Of BGR images, one after the other."""
    values = torch.from_numpy((np.asarray(images, np.float32) - MEAN) / DEVIATION)
    return values.permute(0, 3, 1, 2)  # in memory the channels stay last, which is faster


def loss_of(answers, masks):
    """Cross-entropy, and one minus a soft F1, since few pixels are of bunches."""
    found = torch.sigmoid(answers)
    overlap = (2 * (found * masks).sum() + 1) / (found.sum() + masks.sum() + 1)
    return functional.binary_cross_entropy_with_logits(answers, masks) + 1 - overlap


def train(sets, seed, steps, tell=lambda line: None):
    """The network after so many steps on crops of these sets."""
    start(seed)
    network = Network().to(memory_format=torch.channels_last).train()
    optimiser = torch.optim.AdamW(network.parameters(), lr=LEARNING_RATE, weight_decay=WEIGHT_DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, LEARNING_RATE, total_steps=steps)
    begin, losses = time.monotonic(), []
    for step in range(steps):
        images, masks = crops.batch(sets, seed, step, BATCH)
        loss = loss_of(network(tensor(images)), torch.from_numpy(masks.astype(np.float32)))
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        losses.append(loss.item())
        if (step + 1) % 100 == 0 or step + 1 == steps:
            tell(f"step {step + 1} of {steps}, loss {np.mean(losses[-100:]):.3f}, "
                 f"{time.monotonic() - begin:.0f} s")
    return network.eval()


def finder(network):
    """The mask of a whole picture, whose edges are continued to a size that the network takes."""
    def find(image):
        height, width = image.shape[:2]
        edges = (0, -height % DEPTH), (0, -width % DEPTH), (0, 0)
        with torch.no_grad():
            answer = network(tensor(np.pad(image, edges, "edge")[None]))
        return (answer[0, :height, :width] > 0).numpy()
    return find


def save(network, file):
    torch.save(network.state_dict(), file)


def load(file):
    start(0)
    network = Network().to(memory_format=torch.channels_last)
    network.load_state_dict(torch.load(file, map_location="cpu", weights_only=True))
    return network.eval()
