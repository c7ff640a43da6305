"""The training step of bench/plain_gan.h in PyTorch.

training_peer.py WIDTH PACK BATCH THREADS: answers "ready" when warm, then "done" to each line of
its standard input after one step.
"""
import sys

import torch
from torch import nn
from torch.nn.utils import spectral_norm

LATENT, DECAY = 200, 0.999


class Generator(nn.Module):
    def __init__(self, c):
        super().__init__()
        self.project = nn.Linear(LATENT, 64 * c, bias=False)
        layers = []
        for width in (8 * c, 4 * c, 2 * c):
            layers += [nn.BatchNorm3d(width), nn.ReLU(),
                       nn.ConvTranspose3d(width, width // 2, 4, 2, 1, bias=False)]
        layers += [nn.BatchNorm3d(c), nn.ReLU(), nn.ConvTranspose3d(c, 1, 4, 2, 0)]
        self.layers = nn.Sequential(*layers)
        taps = torch.tensor([0.25, 0.5, 0.25])
        self.register_buffer("blur", taps.view(1, 1, 3, 1, 1) * taps.view(3, 1) * taps)

    def forward(self, z):
        x = self.layers(self.project(z).view(len(z), -1, 2, 2, 2))
        return torch.tanh(nn.functional.conv3d(x, self.blur))


class Discriminator(nn.Module):
    def __init__(self, c, pack):
        super().__init__()
        self.pack = pack
        widths = (pack, c, 2 * c, 4 * c, 8 * c)
        layers = []
        for inside, outside in zip(widths, widths[1:]):
            layers += [spectral_norm(nn.Conv3d(inside, outside, 4, 2, 1)), nn.LeakyReLU(0.2)]
        self.layers = nn.Sequential(*layers, nn.Flatten(), spectral_norm(nn.Linear(64 * c, 1)))

    def forward(self, sdf):
        return self.layers(sdf.view(-1, self.pack, 32, 32, 32)).squeeze(1)


def main():
    width, pack, batch, threads = map(int, sys.argv[1:])
    torch.set_num_threads(threads)
    generator, average = Generator(width), Generator(width)
    discriminator = Discriminator(width, pack)
    adam_g = torch.optim.Adam(generator.parameters(), 4e-4, betas=(0.0, 0.9))
    adam_d = torch.optim.Adam(discriminator.parameters(), 4e-4, betas=(0.0, 0.9))
    shapes = torch.rand(64, 1, 32, 32, 32) * 2 - 1

    def step():
        real = shapes[torch.randint(len(shapes), (batch,))]
        adam_d.zero_grad()
        fake = generator(torch.randn(batch, LATENT)).detach()
        loss = (torch.relu(1 - discriminator(real)).mean()
                + torch.relu(1 + discriminator(fake)).mean())
        loss.backward()
        adam_d.step()
        adam_g.zero_grad()
        loss = -discriminator(generator(torch.randn(batch, LATENT))).mean()
        loss.backward()
        adam_g.step()
        with torch.no_grad():
            for target, source in zip(average.parameters(), generator.parameters()):
                target.lerp_(source, 1 - DECAY)

    step()
    print("ready", flush=True)
    for _ in sys.stdin:
        step()
        print("done", flush=True)


main()
