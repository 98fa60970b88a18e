# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Python imports this at its start: tests run in the locale that MEASUREDBRDF_TEST_LOCALE names, as in a Qt program."""
import locale
import os

if os.environ.get("MEASUREDBRDF_TEST_LOCALE"):
    locale.setlocale(locale.LC_ALL, os.environ["MEASUREDBRDF_TEST_LOCALE"])
    locale.setlocale(locale.LC_MESSAGES, "C")
