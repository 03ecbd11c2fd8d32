"""Read films frame by frame."""

import subprocess

import imageio_ffmpeg
import numpy as np


def frames_of(path, side):
    """All frames of a square film, (n, side, side, 3)."""
    run = subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-loglevel", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
        capture_output=True,
        check=True,
    )
    assert not run.stderr, run.stderr
    return np.frombuffer(run.stdout, np.uint8).reshape(-1, side, side, 3)


def tags_of(path):
    """Return the metadata of the file as text."""
    run = subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-loglevel", "error", "-i", path, "-f", "ffmetadata", "-"],
        capture_output=True,
        check=True,
    )
    return run.stdout.decode().replace("\\", "")
