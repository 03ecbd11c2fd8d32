"""Read films frame by frame."""

import subprocess

import imageio_ffmpeg
import numpy as np


def _converted(path, *words):
    """Return what ffmpeg makes of a file."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-loglevel", "error", "-i", path, *words, "-"]
    run = subprocess.run(command, capture_output=True, check=True)
    assert not run.stderr, run.stderr
    return run.stdout


def frames_of(path, side):
    """All frames of a square film, (n, side, side, 3)."""
    return np.frombuffer(_converted(path, "-f", "rawvideo", "-pix_fmt", "rgb24"), np.uint8).reshape(-1, side, side, 3)


def tags_of(path):
    """Return the metadata of the file as text."""
    return _converted(path, "-f", "ffmetadata").decode().replace("\\", "")
