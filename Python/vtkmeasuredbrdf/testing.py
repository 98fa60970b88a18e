# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Image regression tests: compares pictures as `measured-brdf diff` does.

A picture is a file's name, a vtkImageData, or a NumPy array of shape (height, width), (height, width, 1), (..., 3) or
(..., 4), top row first. uint8 and uint16 are sRGB-encoded, float32 and float64 linear: see vtkPictureDifference.
"""

import collections
import os

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

from ._errors import warn_of_notes
from .vtkMeasuredBRDF import vtkPictureDifference, vtkPictureReader

__all__ = ["Comparison", "assert_images_close", "compare_images"]


class Comparison(collections.namedtuple("Comparison", "metric value threshold passed baseline heat_map")):
    """What compare_images found.

    metric: the figure's name; value: the figure; threshold: the largest value that passes (of "ssim", the least); passed:
    whether it did; baseline: the nearest one, as it was given; heat_map: a vtkImageData of the errors in colors.
    """

    __slots__ = ()

    def __str__(self):
        bound = "at least" if self.metric == "ssim" else "at most"
        return f"{self.metric}={self.value:.9g} ({bound} {self.threshold:.9g})"


def compare_images(
    image, baseline, metric=None, threshold=None, *, alternatives=False, border=0, mask=None, ignore_alpha=False
):
    """Compares a picture with a baseline, or with the nearest of a list of them; returns a Comparison.

    metric: "flip", "hdr_flip", "ssim", "delta_e_2000", "relative_l1" or "max_difference"; None is hdr_flip if both
    pictures hold floats, else flip. threshold: None is the metric's default. alternatives: take BASELINE_1.png,
    BASELINE_2.png and so on, too, as far as there are files. border: pixels along the edges that are not compared. mask:
    a picture of the same size; where it is darker than a half, nothing is compared. ignore_alpha: take all as opaque.

    Raises ValueError, which says what is wrong with which picture, and TypeError for what is no picture.
    """
    baselines = list(baseline) if isinstance(baseline, (list, tuple)) else [baseline]
    if alternatives:
        baselines += _find_alternatives(baselines)
    if not baselines:
        raise ValueError("baseline: the list is empty")
    picture = _to_image(image, "image")
    mask = None if mask is None else _to_image(mask, "mask")
    found = []
    for one in baselines:
        reference = _to_image(one, "baseline")
        if metric is None:  # the same for all that follow
            floats = [each.GetScalarTypeAsString() in ("float", "double") for each in (picture, reference)]
            metric = "hdr_flip" if all(floats) else "flip"
        found.append(_compare(picture, reference, one, metric, threshold, border, mask, ignore_alpha))
    return min(found, key=lambda one: -one.value if one.metric == "ssim" else one.value)


def assert_images_close(image, baseline, metric=None, threshold=None, *, output=None, **options):
    """Raises AssertionError with the figures where compare_images finds the pictures too far apart.

    A failure leaves NAME.diff.png, the errors in colors, and NAME.test.png, the picture if it came as no file, in the
    folder output (default: the current one); NAME is the baseline's. Where CTest runs the program, both are reported to
    CDash. The other arguments are those of compare_images, whose result is returned.
    """
    folder = os.fspath(output) if output is not None else os.curdir
    try:
        comparison = compare_images(image, baseline, metric, threshold, **options)
    except ValueError:
        if not _is_path(image):  # a first run has no baseline yet
            first = baseline[0] if isinstance(baseline, (list, tuple)) and baseline else baseline
            _write(os.path.join(folder, _name(first) + ".test.png"), _to_image(image, "image"))
        raise
    if comparison.passed:
        _report(comparison, {})
        return comparison
    stem = os.path.join(folder, _name(comparison.baseline))
    files = {"DifferenceImage": _write(stem + ".diff.png", comparison.heat_map)}
    files["TestImage"] = os.fspath(image) if _is_path(image) else _write(stem + ".test.png", _to_image(image, "image"))
    if _is_path(comparison.baseline):
        files["ValidImage"] = os.fspath(comparison.baseline)
    _report(comparison, files)
    baseline = comparison.baseline if _is_path(comparison.baseline) else "the baseline"
    raise AssertionError(
        f"{files['TestImage'] or 'the picture'} differs from {baseline}: {comparison}; "
        f"{files['DifferenceImage']} shows where"
    )


def _is_path(image):
    return isinstance(image, (str, os.PathLike))


def _name(baseline):
    return os.path.splitext(os.path.basename(os.fspath(baseline)))[0] if _is_path(baseline) else "image"


def _find_alternatives(baselines):
    if len(baselines) != 1 or not _is_path(baselines[0]):
        raise ValueError("alternatives: they are files beside one baseline, which must be a file's name")
    stem, extension = os.path.splitext(os.fspath(baselines[0]))
    found = []
    while os.path.exists(f"{stem}_{len(found) + 1}{extension}"):
        found.append(f"{stem}_{len(found) + 1}{extension}")
    return found


def _compare(picture, reference, baseline, metric, threshold, border, mask, ignore_alpha):
    number = vtkPictureDifference.FindMetric(metric)
    if number < 0:
        names = map(vtkPictureDifference.GetMetricName, range(vtkPictureDifference.NUMBER_OF_METRICS))
        raise ValueError(f"metric: found {metric!r}, expected one of {', '.join(names)}")
    if threshold is None:
        threshold = vtkPictureDifference.GetDefaultThreshold(number)
    if not 0.0 <= threshold < float("inf"):
        raise ValueError(f"threshold: found {threshold}, expected a finite number of at least 0")
    if not 0 <= border <= 65536:
        raise ValueError(f"border: found {border}, expected a number from 0 to 65536")
    difference = vtkPictureDifference()
    difference.AddObserver("ErrorEvent", lambda *_: None)  # it becomes an exception
    difference.SetMetric(number)
    difference.SetBorder(border)
    difference.SetMask(mask)
    difference.SetIgnoreAlpha(ignore_alpha)
    if not difference.Compare(picture, reference):
        message = difference.GetErrorMessage()
        raise ValueError(f"{os.fspath(baseline)}: {message}" if _is_path(baseline) else message)
    passed = difference.IsWithin(threshold)
    return Comparison(metric, difference.GetValue(), threshold, passed, baseline, difference.NewHeatMap())


def _to_image(image, name):
    if isinstance(image, vtkImageData):
        return image
    if _is_path(image):
        reader = vtkPictureReader()
        reader.AddObserver("ErrorEvent", lambda *_: None)
        reader.SetFileName(os.fspath(image))
        if not reader.Read():
            raise ValueError(f"{name}: {reader.GetErrorMessage()}")
        warn_of_notes(os.fspath(image), reader)
        return reader.GetPicture()
    if not hasattr(image, "__array_interface__") and not hasattr(image, "__array__"):
        raise TypeError(f"{name}: found {type(image).__name__}, expected a file's name, vtkImageData or a NumPy array")
    return _from_array(image, name)


def _from_array(image, name):
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk

    array = numpy.asarray(image)
    if array.dtype not in (numpy.uint8, numpy.uint16, numpy.float32, numpy.float64):
        raise TypeError(f"{name}: found values of type {array.dtype}, expected uint8, uint16, float32 or float64")
    if array.ndim == 2:
        array = array[:, :, numpy.newaxis]
    if array.ndim != 3 or not 1 <= array.shape[2] <= 4 or array.size == 0:
        raise ValueError(f"{name}: found an array of shape {array.shape}, expected (height, width, 1 to 4 channels)")
    height, width, channels = array.shape
    picture = vtkImageData()
    picture.SetDimensions(width, height, 1)
    pixels = numpy.ascontiguousarray(array[::-1]).reshape(-1, channels)
    picture.GetPointData().SetScalars(numpy_to_vtk(pixels, deep=True))
    return picture


def _write(path, image):
    """Returns the path of the PNG; None for a picture of floats, which PNG does not hold."""
    if image.GetScalarTypeAsString() in ("float", "double"):
        return None
    writer = vtkPNGWriter()
    writer.SetFileName(path + ".part")  # what is there stays until the new one is whole
    writer.SetInputData(image)
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"{path}: can't be written")
    os.replace(path + ".part", path)
    return path


def _report(comparison, files):
    """What CTest takes out of a test's output for CDash, as vtkTesting prints it."""
    if not {"CTEST_INTERACTIVE_DEBUG_MODE", "DASHBOARD_TEST_FROM_CTEST"} & set(os.environ):  # CTest sets one of them
        return
    for name, value in ((comparison.metric, comparison.value), (comparison.metric + "_threshold", comparison.threshold)):
        print(f'<DartMeasurement name="{name}" type="numeric/double">{value:.9g}</DartMeasurement>')
    for name, path in files.items():
        if path:
            kind = "image/png" if path.lower().endswith(".png") else "file"
            print(f'<DartMeasurementFile name="{name}" type="{kind}">{os.path.abspath(path)}</DartMeasurementFile>')
