"""Pictures to one file: a PNG, or a film as GIF, WebP or MP4. What packs them comes with the extra `film`."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from geartrain.errors import MissingExtraError, Problem, QuestionError, suggest

if TYPE_CHECKING:
    from PIL.Image import Image

    from geartrain.viewer.shot import Shot

_SAMPLES, _COLOURS = 8, 256  # pictures from which the colours of a GIF are chosen
_HUNDREDTHS = 100  # a GIF counts time in them
_QUALITY = {"webp": 80, "crf": "20"}


def _png(pictures: Iterator[bytes], shot: Shot) -> bytes:
    (picture,) = pictures
    return picture


def _gif(pictures: Iterator[bytes], shot: Shot) -> bytes:
    """One palette for all, so that nothing at rest flickers; no dither, so that what rests is stored once."""
    from PIL import Image

    images = list(_images(pictures))
    some = images[:: max(1, len(images) // _SAMPLES)]
    sheet = Image.new("RGB", (shot.size[0], shot.size[1] * len(some)))
    for n, image in enumerate(some):
        sheet.paste(image, (0, n * shot.size[1]))
    palette = sheet.quantize(_COLOURS)
    first, *rest = (image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images)
    out = io.BytesIO()
    times = [10 * each for each in _hundredths(len(images), shot.fps)]
    first.save(out, "GIF", save_all=True, append_images=rest, duration=times, loop=0, optimize=True)
    return out.getvalue()


def _hundredths(count: int, fps: int) -> list[int]:
    """How long each picture of a GIF stands, in hundredths of a second, so that none strays from its time."""
    ends = [round(n * _HUNDREDTHS / fps) for n in range(count + 1)]
    return [max(1, end - begin) for begin, end in pairwise(ends)]


def _webp(pictures: Iterator[bytes], shot: Shot) -> bytes:
    first, *rest = _images(pictures)
    out = io.BytesIO()
    first.save(
        out,
        "WEBP",
        save_all=True,
        append_images=rest,
        duration=round(1000 / shot.fps),
        loop=0,
        quality=_QUALITY["webp"],
    )
    return out.getvalue()


def _mp4(pictures: Iterator[bytes], shot: Shot) -> bytes:
    """H.264 in a form that every browser and player shows, its index first, so that it can start before it is whole."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"  # the index goes first once all is written, which takes a file
        _encode(path, pictures, shot)
        return path.read_bytes()


def _encode(path: Path, pictures: Iterator[bytes], shot: Shot) -> None:
    import av
    import numpy
    from av.video.stream import VideoStream

    with av.open(str(path), "w", format="mp4", options={"movflags": "faststart"}) as file:
        stream = file.add_stream("libx264", rate=shot.fps, options={"crf": str(_QUALITY["crf"])})
        assert isinstance(stream, VideoStream)
        stream.width, stream.height, stream.pix_fmt = *shot.size, "yuv420p"
        for image in _images(pictures):
            file.mux(stream.encode(av.VideoFrame.from_ndarray(numpy.asarray(image), format="rgb24")))
        file.mux(stream.encode(None))


def _images(pictures: Iterator[bytes]) -> Iterator[Image]:
    from PIL import Image

    for picture in pictures:
        yield Image.open(io.BytesIO(picture)).convert("RGB")


def mixed(one: bytes, other: bytes, share: float) -> bytes:
    """A PNG between two: the share of the other in it, from 0 to 1."""
    from PIL import Image

    first, second = _images(iter((one, other)))
    out = io.BytesIO()
    Image.blend(first, second, share).save(out, "PNG")
    return out.getvalue()


FORMATS: Mapping[str, Callable[[Iterator[bytes], Shot], bytes]] = {
    ".png": _png,
    ".gif": _gif,
    ".webp": _webp,
    ".mp4": _mp4,
}
"""What packs pictures, by suffix."""


def check_format(suffix: str, shot: Shot) -> None:
    """Make sure that a film can be packed, before it is drawn.

    Raises
    ------
    MissingExtraError
        Where what packs it is not installed.
    QuestionError
        For an unknown form, and for a size that an MP4 cannot have.
    """
    if suffix not in FORMATS:
        why = f"the suffix says how it is packed, and '{suffix}' is none"
        raise QuestionError(Problem("no picture and no film", why, suggest(suffix, FORMATS)))
    if suffix == ".mp4" and any(side % 2 for side in shot.size):
        why = "an MP4 keeps colours for two by two points"
        raise QuestionError(Problem(f"no MP4 has {shot.size[0]} by {shot.size[1]} points", why, "give even sides"))
    try:
        if suffix in (".gif", ".webp"):
            import PIL
        elif suffix == ".mp4":
            import av  # noqa: F401
            import PIL  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(str(error.name), "film", "a film") from None
