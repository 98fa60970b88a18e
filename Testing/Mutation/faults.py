# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The small faults that mutate.py puts into the code, one at a time.

A fault changes one behavior and compiles. Its name begins with its component. The old text must occur exactly once in its file.
The tests are a regular expression: few and fast tests that cover the place, as Suite.Name, separated by "|".
A fault that changes nothing that anybody could see is marked with the reason, equivalent="...".
"""

import collections
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

COMPONENTS = ("Core", "Material", "Lighting", "Integration", "Metrics", "Fitting", "IO", "Planning", "Rendering",
         "Sources", "Visibility", "Shaders", "Export", "Fetch", "Laboratory")

# Where the files of a component are, but for the module's.
FOLDERS = {"Shaders": "shaders/", "Export": "Applications/Export/", "Fetch": "Applications/Fetch/",
           "Laboratory": "Applications/Laboratory/"}

Fault = collections.namedtuple("Fault", "id file old new tests equivalent")
FAULTS = []


def find(folder, name):
    """The path of the file of this name below a folder, relative to the repository."""
    for path, _, names in os.walk(os.path.join(ROOT, folder)):
        if name in names:
            return os.path.relpath(os.path.join(path, name), ROOT)
    return os.path.join(folder, name)


def add(id, file, old, new, tests, equivalent=""):
    component = id.split(".")[0]
    path = find(FOLDERS.get(component, f"Module/{component}/"), file)
    FAULTS.append(Fault(id, path, old, new, tests, equivalent))


# Core

add("Core.half-vector-difference", "HalfVector.h", "const glm::dvec3 sum = i + o;",
    "const glm::dvec3 sum = i - o;", "BlinnPhong.PaperFormula")
add("Core.log-cosine-sign", "HalfVector.h", "std::log1p(-s) / s", "std::log1p(s) / s",
    "BlinnPhong.PaperFormula")
add("Core.half-vector-spread-factor", "HalfVector.h", "return spread / (4.0 *", "return spread / (2.0 *",
    "SoftLights.AreTheMeanOverTheLight|SoftTables.AgreeWithTheClosedForm")
add("Core.whole-file-forgets-permissions", "WholeFile.cxx", "old.permissions() & fs::perms(0777)", "fs::perms(0777)",
    "WholeFile.IsNewOrReplacesTheOldOne")
add("Core.own-threads-nest", "ParallelFor.cxx", "!isInLoop && static_cast", "static_cast", "OwnThreads.RunEachElementOnce")
add("Core.own-threads-skip", "ParallelFor.cxx", "part(begin, std::min(begin + step, last));", "part(begin, std::min(begin + step, last - 1));",
    "OwnThreads.RunEachElementOnce")
add("Core.schlick-fourth-power", "HalfVector.h", "f0 + (1.0 - f0) * m2 * m2 * m;",
    "f0 + (1.0 - f0) * m2 * m2;", "AshikhminShirley.PaperFormula")
add("Core.dielectric-square", "HalfVector.h", "return 0.5 * a * a * (1.0 + b * b);",
    "return 0.5 * a * (1.0 + b * b);", "AshikhminShirley.PaperFormula|IOFits.ReadsLow")
add("Core.half-difference-azimuth", "HalfVector.h", "cosPhi * i.y - sinPhi * i.x;",
    "cosPhi * i.y + sinPhi * i.x;", "Tabulated.InterpolatesTrilinearly|Resampler.ErrorFallsAndIsReported")
add("Core.sample-cosine-radius", "HalfVector.h", "const double r = std::sqrt(u1);", "const double r = u1;",
    "Sampling.FollowsItsPdf")
add("Core.gauss-legendre-weight", "BasisFunctions.h", "2.0 / ((1.0 - x * x)", "1.0 / ((1.0 - x * x)",
    "GaussLegendre.ExactToItsDegree")
add("Core.legendre-recurrence-sign", "BasisFunctions.h", "x * p1 - k * p0) / (k + 1.0)",
    "x * p1 + k * p0) / (k + 1.0)", "BasisFunctions.Orthonormal")
add("Core.azimuth-without-root-two", "BasisFunctions.h",
    "const double s = std::sqrt(2.0) * std::sin(m * phi);", "const double s = std::sin(m * phi);",
    "BasisFunctions.Orthonormal")
add("Core.zone-without-clamp", "BasisFunctions.h",
    "return std::clamp(2.0 * (cosine - this->Far) / (this->Near - this->Far) - 1.0, -1.0, 1.0);",
    "return 2.0 * (cosine - this->Far) / (this->Near - this->Far) - 1.0;",
    "BasisFunctions.Edges|BasisBRDF.ConstantBeyondTheZones")
add("Core.negative-weights-count", "Distribution.h", "std::isfinite(w) && w > 0.0 ? w : 0.0",
    "std::isfinite(w) ? w : 0.0", "Distribution1D.ProbabilitiesAndInversion")
add("Core.boundary-belongs-to-the-cell-before", "Distribution.h",
    "std::upper_bound(this->Cdf.begin() + 1, this->Cdf.end(), u)",
    "std::lower_bound(this->Cdf.begin() + 1, this->Cdf.end(), u)", "Distribution1D.ProbabilitiesAndInversion")
add("Core.row-by-the-wrong-number", "Distribution.h", "y = this->Marginal.Invert(v, rv);",
    "y = this->Marginal.Invert(u, rv);", "Distribution2D.SamplesFollowTheWeights")
add("Core.radical-inverse-digits", "LowDiscrepancy.h", "index /= base;\n    digit /= base;",
    "index /= base;\n    digit /= 2.0;", "LowDiscrepancy.RadicalInverseAndWrap")
add("Core.wrap-keeps-negative-numbers", "LowDiscrepancy.h", "return x < 0.0 ? x + 1.0 : x;", "return x;",
    "LowDiscrepancy.RadicalInverseAndWrap")
add("Core.left-handed-frame", "LocalFrame.h", "return Frame(p / length, glm::cross(n, p / length), n);",
    "return Frame(p / length, glm::cross(p / length, n), n);",
    "Parity.Tables|ExactIntegrator.EqualsAPlainSum|EveryMethod.TurnsWithItsEnvironment")
add("Core.views-are-lifted-too-far", "LocalFrame.h", "MinimumViewCosine = 0.02;", "MinimumViewCosine = 0.05;",
    "MapperShading.GrazingViews|EveryMethod.LowViewsAreLifted")
add("Core.hash-of-the-last-piece", "ContentHash.cxx", "{ this->State[0], this->State[1], piece.low64",
    "{ 0, 0, piece.low64", "EveryModel.EverythingThatCountsChangesTheKey")
add("Core.warp-weights-of-slices", "BilinearWarp.h", "result.Weight[k] *= 1.0 - w;", "result.Weight[k] *= w;",
    "IOTensor.Reads|IOTensor.AgreesWithTheAuthorsCode|Sampling.FollowsItsPdf")
add("Core.warp-inverts-without-cells", "BilinearWarp.h",
    "density = glm::mix(c.x, c.y, fraction.x) * this->GetCellsPerSquare();", "density = glm::mix(c.x, c.y, fraction.x);",
    "IOTensor.AgreesWithTheAuthorsCode|Sampling.FollowsItsPdf")
add("Material.tabulated-lanes-have-no-sign", "vtkTabulatedBRDF.cxx",
    "(across < 0.0f ? -turns : turns) *", "turns *", "ManyLights.OfTables")
add("Material.tabulated-lanes-divide-by-no-cosine", "vtkTabulatedBRDF.cxx",
    "this->CosineWeighted ? static_cast<float>(1.0 / o[2]) : 1.0f;", "1.0f;", "ManyLights.OfTables")
add("Material.packed-rows-are-all-the-first", "vtkAdaptiveWarpBRDF.cxx",
    "const Floats whole = totals[0] + down * (totals[2] - totals[0]);", "const Floats whole = totals[0];",
    "ManyLights.OfAdaptiveWarps|ManyLights.OfAMeasuredMaterial")
add("Material.lanes-half-turn-the-wrong-way", "vtkAdaptiveWarpBRDF.cxx",
    "const Floats across = fromX * s.Half.Y - s.Light.Y * s.Half.X;",
    "const Floats across = s.Light.Y * s.Half.X - fromX * s.Half.Y;",
    "ManyLights.OfAdaptiveWarps|ManyLights.OfAMeasuredMaterial")
add("Material.packed-slices-are-not-mixed", "vtkAdaptiveWarpBRDF.cxx",
    "const std::ptrdiff_t next = this->Thetas.size() > 1 ? 1 : 0;", "const std::ptrdiff_t next = 0;",
    "ManyLights.OfAdaptiveWarps|ManyLights.OfAMeasuredMaterial")
add("Material.many-lights-share-an-azimuth", "vtkAdaptiveWarpBRDF.cxx",
    "const Floats fromX = size > 0.0f ? s.Light.X : Fill(1.0f);", "const Floats fromX = Fill(1.0f);",
    "ManyLights.OfAdaptiveWarps|ManyLights.OfAMeasuredMaterial")
add("Core.srgb-exponent", "SRGB.h", "1.055, 2.4)", "1.055, 2.2)", "Environment.DecodesSRGB")
add("Core.periodic-neighbors-do-not-wrap", "Neighbors.h",
    "const int first = (static_cast<int>(base) + n) % n;", "const int first = std::max(static_cast<int>(base), 0);",
    "Tabulated.InterpolatesTrilinearly|TableIntegrator.Continuous")
add("Core.clamped-neighbors-half-a-cell-off", "Neighbors.h", "std::clamp(u * n - 0.5, 0.0, n - 1.0)",
    "std::clamp(u * n, 0.0, n - 1.0)", "Parity.Tables|SoftTables.FollowTheDistribution")
add("Core.retro-density-factor", "RetroLobe.h", "1.0 / (2.0 * Pi * GetRange()", "1.0 / (Pi * GetRange()",
    "RetroReflection.AlbedoCountsIt")
add("Core.refused-numbers-are-taken", "Setters.h", "if (!measuredbrdf::AreFinite(values, 3))",
    "if (!measuredbrdf::AreFinite(values, 0))", "Setters.OfMaterials")

# Material

add("Material.array-of-one-tuple-is-walked", "vtkBRDF.cxx", "GetNumberOfTuples() == 1 ? 0 : k", "GetNumberOfTuples() == 0 ? 0 : k",
    "Arrays.OneTupleServesForAll")
add("Material.array-result-overwrites-its-input", "vtkBRDF.cxx", "input.Array = copies.back();", "",
    "Arrays.TheResultMayBeAnInput")
add("Material.array-sizes-unchecked", "vtkBRDF.cxx", "tuples != 1 && count != 1 && tuples != count",
    "tuples != 1 && count != 1 && tuples < 0", "Arrays.WhatDoesNotFitIsRefused")
add("Material.array-result-of-any-type", "vtkBRDF.cxx", "to->GetDataType() == VTK_FLOAT || to->GetDataType() == VTK_DOUBLE",
    "to->GetDataType() >= 0", "Arrays.WhatDoesNotFitIsRefused")
add("Material.array-blocks-lie-on-another", "vtkBRDF.cxx", "to->SetTuple(k, value);", "to->SetTuple(k - begin, value);",
    "Arrays.AreTheScalarCalls")
add("Material.array-sample-with-one-number", "vtkBRDF.cxx", "inputs[1][0], inputs[1][1], result",
    "inputs[1][0], inputs[1][0], result", "Arrays.AreTheScalarCalls")
add("Material.lambert-without-pi", "vtkLambertBRDF.cxx", "return albedo / measuredbrdf::Pi;",
    "return albedo;", "Lambert.ClosedForm")
add("Material.blinn-phong-normalization", "vtkBlinnPhongBRDF.cxx", "const double lobe = (n + 2.0)",
    "const double lobe = (n + 1.0)", "BlinnPhong.PaperFormula")
add("Material.blinn-phong-jacobian", "vtkBlinnPhongBRDF.cxx", "(4.0 * glm::dot(view, h));",
    "(2.0 * glm::dot(view, h));", "Sampling.FollowsItsPdf")
add("Material.blinn-phong-copy-without-exponent", "vtkBlinnPhongBRDF.cxx", "copy->Exponent = this->Exponent;", "",
    "EveryModel.SnapshotsAreTheSameAndIndependent")
add("Material.ashikhmin-shirley-swapped-exponents", "vtkAshikhminShirleyBRDF.cxx", "nu * h.x * h.x + nv * h.y * h.y",
    "nv * h.x * h.x + nu * h.y * h.y", "AshikhminShirley.PaperFormula")
add("Material.ashikhmin-shirley-diffuse-at-full-reflectance", "vtkAshikhminShirleyBRDF.cxx",
    "diffuse * this->Diffuse[c] * (1.0 - this->Reflectance[c]);", "diffuse * this->Diffuse[c];",
    "AshikhminShirley.PaperFormula")
add("Material.key-without-numbers", "vtkBRDFModels.cxx", "hash.AddValues(numbers);", "",
    "EveryModel.EverythingThatCountsChangesTheKey")
add("Material.ashikhmin-shirley-two-quadrants", "vtkAshikhminShirleyBRDF.cxx",
    "quadrant == 1.0 || quadrant == 2.0 ? -1.0", "quadrant >= 2.0 ? -1.0", "Sampling.FollowsItsPdf")
add("Material.distribution-denominator", "vtkDistributionBRDF.cxx", "4.0 * (light.z + view.z - light.z * view.z)",
    "4.0 * (light.z + view.z)", "Distribution.RetroReflectionInvertsToP|Evaluate.KeepsItsPromises|Parity.ClosedForms")
add("Material.distribution-keeps-old-levels", "vtkDistributionBRDF.cxx",
    "this->ResetLobe();\n  this->WidenedLevels.reset();", "this->ResetLobe();",
    "SoftTables.FollowTheDistribution")
add("Material.distribution-fresnel-unit", "vtkDistributionBRDF.cxx", "ClampedNeighbors(angles.ThetaD * (2.0 / Pi),",
    "ClampedNeighbors(angles.ThetaD,",
    "Distribution.RetroReflectionInvertsToP|Parity.ClosedForms|KnownFit.ComesBack")
add("Material.tabulated-azimuth-range", "VolumeInterpolation.h", "angles.PhiD / (halfTurn ? Pi : 2.0 * Pi)",
    "angles.PhiD / (halfTurn ? 2.0 * Pi : Pi)", "Tabulated.InterpolatesTrilinearly")
add("Material.tabulated-divides-by-the-other-cosine", "vtkTabulatedBRDF.cxx",
    "const double divisor = this->CosineWeighted ? o[2]", "const double divisor = this->CosineWeighted ? i[2]",
    "Tabulated.InterpolatesTrilinearly|Parity.Tables|Resampler.ZonesNextToTheHorizon")
add("Material.tabulated-invalid-cells-are-black", "vtkTabulatedBRDF.cxx",
    "v[0] = v[1] = v[2] = std::numeric_limits<float>::quiet_NaN();", "v[0] = v[1] = v[2] = 0.0f;",
    "IOMerl.CountsWhatIsNotFinite|Fit.HolesInATableDoNotCount")
add("Material.tabulated-never-makes-levels", "vtkTabulatedBRDF.cxx",
    "this->WidenedLevels = std::make_shared<Levels>();", "", "SoftTables.AgreeWithTheClosedForm")
add("Material.tabulated-shared-exponents-of-negative-values", "vtkTabulatedBRDF.cxx",
    "[](float v) { return v >= 0.0f; }", "[](float) { return true; }", "Tabulated.PrecisionFollowsTheTolerance")
add("Material.tabulated-half-floats-overflow", "ModuleShader.h", "32768.0f / peak", "131072.0f / peak",
    "Parity.Tables|Parity.EmbeddedMeasurement|Tabulated.PrecisionFollowsTheTolerance")
add("Material.tabulated-copy-without-cosine", "vtkTabulatedBRDF.cxx", "copy->CosineWeighted = this->CosineWeighted;",
    "", "EveryModel.EverythingThatCountsChangesTheKey")
add("Material.tabulated-theta-d-of-a-cell", "vtkTabulatedBRDF.cxx",
    "const double second = 0.5 * Pi * (y + 0.5) / dimensions[1];",
    "const double second = 0.5 * Pi * y / dimensions[1];",
    "Tabulated.InterpolatesTrilinearly|Resampler.ErrorFallsAndIsReported|BRDFAnalysis.NegativeMassOfATable")
add("Material.sum-holds-itself", "vtkSumBRDF.cxx", "if (!term || Holds(term, this))", "if (!term || term == this)",
    "Sum.GuardsItsTerms")
add("Material.sum-holds-one-more", "vtkSumBRDF.cxx", "this->GetNumberOfTerms() == MaximumNumberOfTerms",
    "this->GetNumberOfTerms() > MaximumNumberOfTerms", "Sum.HoldsSoManyTermsOnly")
add("Material.sum-of-the-last-term", "vtkSumBRDF.cxx",
    "std::transform(part, part + 3, sum, sum, std::plus<double>());", "std::copy(part, part + 3, sum);",
    "Evaluate.KeepsItsPromises|Parity.ClosedForms|EveryModel.SumsAreTheirTerms|IOFits.ReadsLow")
add("Material.snapshot-without-source", "vtkBRDF.cxx", "copy->Source = this->Source;", "",
    "EveryModel.SnapshotsAreTheSameAndIndependent")
add("Material.albedo-of-first-squares", "HemisphereIntegral.cxx", "!isEnough() &&", "false &&",
    "ReflectionIntegral.IsWithinItsToleranceForModels|ReflectionIntegral.IsWithinItsToleranceForMeasuredMaterials")

add("Material.photographs-without-cosine", "vtkPhotographSet.cxx",
    "photograph.Exposure * this->Irradiance * photograph.Light[2]", "photograph.Exposure * this->Irradiance",
    "PhotographSet.RefusesDirectionsBelowTheHorizon")
add("Lighting.texel-solid-angle", "vtkEnvironment.cxx", "2.0 * Pi / this->Width * 2.0 * std::sin",
    "2.0 * Pi / this->Width * std::sin", "Environment.SolidAnglesAddUpToTheSphere")
add("Lighting.azimuth-runs-backwards", "vtkEnvironment.cxx", "direction[2] = std::cos(latitude) * std::sin(phi);",
    "direction[2] = -std::cos(latitude) * std::sin(phi);",
    "Environment.DirectionsFollowVTKsImageBasedLighting|Environment.TexelDirectionsFindTheirTexel")
add("Core.luminance-red-and-green", "SRGB.h", "0.2126 * rgb[0] + 0.7152 * rgb[1]",
    "0.7152 * rgb[0] + 0.2126 * rgb[1]",
    "PictureMetrics.AgreeWithOtherPrograms|Generators.SingleBrightTexel|MedianCut.HalvesAreBalanced")
add("Lighting.rotation-the-other-way", "vtkEnvironment.cxx", "{ c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c }",
    "{ c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c }", "Environment.Rotation")
add("Lighting.mirrored-rotation-is-taken", "vtkEnvironment.cxx", "rows[2]) < 0.0)", "rows[2]) < -2.0)",
    "Environment.Rotation")
add("Lighting.swapped-counts", "RadianceValues.cxx", "negative : notFinite",
    "notFinite : negative", "Environment.RepairsAndCounts")
add("Lighting.colors-are-gray", "RadianceValues.cxx", "components == 1 ? 0 : static_cast<int>(k % 3);",
    "0;", "Environment.TakesImagesOfAnyType")
add("Lighting.snapshot-without-rotation", "vtkEnvironment.cxx",
    "std::copy_n(this->WorldToEnvironment, 9, snapshot->WorldToEnvironment);", "", "EnvironmentSnapshots.ShareWhatNeverChanges")
add("Lighting.new-pixels-old-time", "vtkEnvironment.cxx", "this->PixelsTime.Modified();\n  this->Modified();",
    "this->Modified();", "Planner.PlansAgainExactlyWhenItMust")
add("Lighting.cut-up-texels-are-moved", "vtkEnvironment.cxx", "Interpolate(this, (x + 0.5) / width, (y + 0.5) / height)",
    "Interpolate(this, (x + 1.0) / width, (y + 0.5) / height)", "CoarseMaps.AreCutUpWithoutChangingTheirLight")
add("Core.seam-is-not-crossed", "Neighbors.h", "x = PeriodicNeighbors(u,",
    "x = ClampedNeighbors(u,", "Environment.InterpolatesBetweenTexels|EnvironmentHarmonics.AreIntegralsOfTheInterpolatedSky")
add("Lighting.harmonics-of-point-masses", "EnvironmentHarmonics.cxx", "* sinc * sinc, half)", ", half)",
    "EnvironmentHarmonics.AreIntegralsOfTheInterpolatedSky")
add("Lighting.harmonics-of-one-hemisphere", "EnvironmentHarmonics.cxx", "(north - south).real()", "(north + south).real()",
    "EnvironmentHarmonics.AreIntegralsOfTheInterpolatedSky")
add("Lighting.old-light-in-new-pixels", "vtkEnvironment.cxx",
    "this->Parts = vtkEnvironment::MakeParts();\n  this->PixelsTime", "this->PixelsTime",
    "PlanMemory.GoesWithThePixels|EveryMethod.FollowsItsInputs")
add("Lighting.concentration-formula", "vtkLightSet.cxx", "r * (3.0 - r * r)", "r * (2.0 - r * r)",
    "LightConcentration.FromVariance")
add("Lighting.directions-of-any-length", "vtkLightSet.cxx", "light.Direction[c] = direction[c] / length;",
    "light.Direction[c] = direction[c];", "LightSet.AddsAndRefuses")
add("Lighting.total-of-red", "vtkLightSet.cxx", "rgb[c] += light.Irradiance[c];", "rgb[c] += light.Irradiance[0];",
    "LightSet.AddsAndRefuses|Generators.KeepTheEnergy")
add("Lighting.lower-half-of-the-octahedron", "EnvironmentPyramid.cxx", "std::swap(u, v);\n    u = 1 - u;",
    "u = 1 - u;", "EnvironmentPyramid.IsContinuousAcrossAllFourFolds|FilteredIntegrator.MirrorShowsTheEnvironment")
add("Lighting.median-cut-takes-any-number", "vtkLightSetGenerator.cxx", "(count & (count - 1)) != 0",
    "(count & 1) != 0", "Generators.RefuseBadArguments")
add("Lighting.median-cut-energy", "LightTree.cxx", "this->Irradiance += solidAngle * rgb;",
    "this->Irradiance += rgb;", "Generators.KeepTheEnergy")
add("Lighting.importance-weights", "vtkLightSetGenerator.cxx",
    "weights.push_back(solidAngle * GetLuminance", "weights.push_back(GetLuminance",
    "Importance.Unbiased|Generators.KeepTheEnergy")
add("Lighting.importance-ignores-the-seed", "vtkLightSetGenerator.cxx", "std::mt19937 engine(seed);",
    "std::mt19937 engine(1);", "Importance.SameOnEveryMachine")
add("Lighting.lamps-leave-their-light", "ExtractedEmitters.cxx", "irradiance = (value - kept) *",
    "irradiance = value *", "ExtractedEmitters.LightsAndRestAddUp")
add("Lighting.faces-upside-down", "LightProbe.cxx", "{ { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } }",
    "{ { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } }",
    "Probes.MapsAreInverse|Probes.CubeFacesAreOpenGLs")
add("Lighting.mirror-ball-angle", "LightProbe.cxx", "ball ? std::sin(0.5 * angle)", "ball ? std::sin(0.25 * angle)",
    "Probes.MapsAreInverse|Probes.ASmoothSkyIsItself")
add("Lighting.harmonics-scale", "EnvironmentHarmonics.cxx", "factors[m] * std::conj(series[m % columns])",
    "factors[m] * series[m % columns]", "EnvironmentHarmonics.AreIntegralsOfTheInterpolatedSky")

# Integration

add("Lighting.parts-are-the-texel", "TexelTree.cxx", "(x + 0.5) / at.Width, (y", "(x + 0.0) / at.Width, (y",
    "TexelTree.PartsAreInterpolated")
add("Integration.adaptive-stops-at-texels", "AdaptiveSum.cxx",
    "if (level == this->Texels->GetLowestLevel())", "if (level <= 0)",
    "AdaptiveIntegrator.KeepsItsToleranceAtEachPair|AdaptiveIntegrator.MissesNothingNarrow")
add("Integration.adaptive-takes-the-square-for-its-quarters", "AdaptiveSum.cxx",
    "this->Count(square, -1.0);", "", "AdaptiveIntegrator.ConvergesWithItsTolerance")
add("Integration.adaptive-looks-nowhere-first", "AdaptiveSum.cxx",
    "if (reach > 0.0f &&", "if (reach > 1e9f &&",
    "AdaptiveIntegrator.MissesNothingNarrow|AdaptiveIntegrator.IsNotMisledByChance")
add("Integration.group-has-one-frame", "AdaptiveSum.cxx",
    "step.Turn(count, this->Rows[pair]);", "step.Turn(count, this->Rows[0]);", "AdaptiveGroup.IsWithinItsTolerance")
add("Integration.group-takes-the-first-pair-for-all", "AdaptiveSum.cxx",
    "this->Steps[pair].GetValue(at + quarter)", "this->Steps[0].GetValue(at + quarter)", "AdaptiveGroup.IsWithinItsTolerance")
add("Integration.middles-that-do-not-count-stay", "AdaptiveSum.cxx",
    "this->Lights[c][k] = this->Lights[c][this->Numbers[k]];", "this->Lights[c][k] = this->Lights[c][k];",
    "AdaptiveGroup.*|AdaptiveIntegrator.*")
add("Lighting.quarters-of-a-part-are-the-other-way", "TexelTree.cxx",
    "2 * x + k % 2, 2 * y + k / 2);",
    "2 * x + k / 2, 2 * y + k % 2);", "TexelTree.QuartersAreTheSquaresBelow")
add("Integration.peaks-of-the-wrong-azimuth", "AdaptiveSum.cxx",
    "peaks.Azimuth = s > 0.0 ? glm::dvec2(o.x, o.y) / s", "peaks.Azimuth = s > 0.0 ? glm::dvec2(o.x, -o.y) / s",
    "ReflectionGuide.KnowsPeaks")
add("Integration.core-takes-the-blur-too", "RadianceCore.cxx", "inTable * share[channel] * taken", "0.0",
    "FactoredIntegrator.MirrorsInFewMegabytes|EveryMethod.WhiteFurnaceIsTheDirectionalAlbedo")
add("Integration.core-turns-backwards", "RadianceCore.cxx", "turn.y * GetCenteredValue(",
    "-turn.y * GetCenteredValue(", "FactoredIntegrator.MapsConverge|Parity.FactoredIntegrator")
add("Integration.core-of-gray-weights", "RadianceCore.cxx", "const Eigen::Index at = 3 * static_cast<Eigen::Index>(low) + c;",
    "const Eigen::Index at = 3 * static_cast<Eigen::Index>(low);", "FactoredIntegrator.MapsConverge")
add("Integration.maps-half-a-column-off", "FieldSynthesis.cxx", "std::polar(1.0f, static_cast<float>(-Pi * frequency))",
    "std::polar(1.0f, static_cast<float>(Pi * frequency))", "FactoredIntegrator.MapsConverge|FactoredIntegrator.MirrorsInFewMegabytes")
add("Integration.lamps-ring", "RadianceTable.h", "const double from = 0.6 * rows;", "const double from = degree;",
    "FactoredIntegrator.*|TableIntegrator.*|TableReference.*")
add("Integration.irradiance-in-one-unit-only", "RadianceTable.cxx",
    "irradiance->Scale = static_cast<float>(PackRadiance(values, irradiance->Texels));",
    "PackRadiance(values, irradiance->Texels);", "LightUnits.ReachFromFaintToStrong")
add("Integration.table-without-its-blur", "RadianceTable.cxx", "smoothed[b % size] * static_cast<float>(knots", "static_cast<float>(knots",
    "EveryMethod.WhiteFurnaceIsTheDirectionalAlbedo|FactoredIntegrator.MirrorsInFewMegabytes")
add("Integration.no-splines-along-rows", "FieldSynthesis.cxx", "of.Above != MapPart::None && of.Below != MapPart::None", "false", "LinearSpline.*|TableReference.ErrorFallsWithSize*|AnisotropicTable.*")
add("Integration.tiles-where-nothing-bends", "RadianceTable.cxx", "scores[a] > scores[b]", "scores[a] < scores[b]",
    "TableTiles.*")
add("Integration.tiles-with-seams", "RadianceTable.cxx", "!tile.Own[k].IsInside", "false",
    "TableTiles.NoSeams")
add("Integration.tiles-of-any-size", "RadianceTable.cxx", "std::ceil((others + LeastTileBytes) / BytesStep)", "std::ceil((others + LeastTileBytes) / BytesStep + 1.0)",
    "TableTiles.FillWhatIsAllowed")
add("Integration.tiles-of-few-nodes", "vtkTableRadianceIntegrator.cxx", "constexpr int NodesOfTiles = 2; ", "constexpr int NodesOfTiles = 1; ",
    "TableTiles.KernelsHaveNodesEnough")
add("Integration.fine-kernels-stay", "MaterialPrecomputation.cxx", " || sizes[1] > mostNodes", "",
    "MaterialPrecomputation.MakesForgottenNodesAgain")
add("Integration.forgotten-nodes-stay-so", "MaterialPrecomputation.cxx", " && !(areNodesWanted && !kernels.At.front().HasNodes())", "",
    "MaterialPrecomputation.MakesForgottenNodesAgain")
add("Integration.nodes-made-again-for-nothing", "MaterialPrecomputation.cxx", "use.Nodes || kernels", "true || kernels",
    "MaterialPrecomputation.MakesForgottenNodesAgain")
add("Integration.rings-end-at-the-seam", "SynthesisLanes.cxx", "map.leftCols(3) = map.middleCols(width, 3);", "", "RingLimiter.*")
add("Lighting.sets-of-one-tree-are-one-set", "EnvironmentPrecomputation.cxx", "tree.FillLightSet(count, sets->back());",
    "tree.FillLightSet(count / 2 + 1, sets->back());", "EnvironmentPrecomputation.SetsOfOneTreeAreThoseOfTheirOwn")
add("Integration.beyond-the-pole-unturned", "FieldSynthesis.cxx", "order % 2 != 0 ? -1.0f : 1.0f", "order % 2 != 0 ? 1.0f : 1.0f",
    "AnisotropicTable.*|TableIntegrator.*|LinearSpline.*")
add("Integration.products-miss-a-vector", "SynthesisLanes.cxx", "left.First[row] * of[v];", "left.First[row] * of[0];",
    "TableReference.*|TableIntegrator.*|MaterialPrecomputation.*")
add("Integration.lanes-begin-at-degree-zero", "SynthesisLanes.cxx", "{ out[0] + first, out[1] + first,",
    "{ out[0], out[1] + first,", "TableReference.*|TableIntegrator.*")
add("Integration.expanded-kernels-of-other-orders", "MaterialPrecomputation.cxx", "static_cast<std::ptrdiff_t>(row) * (this->Degree + 1)",
    "static_cast<std::ptrdiff_t>(row) * (degree + 1)", "MaterialPrecomputation.KeepsExpandedKernels")
add("Integration.degrees-left-out", "RadianceTable.cxx", "constexpr double LeastShare = 1e-4;", "constexpr double LeastShare = 1e9;",
    "TableReference.*|TableIntegrator.*")
add("Integration.rings-stay", "SynthesisLanes.cxx", "constexpr float LeastOfBlur = 0.75f;", "constexpr float LeastOfBlur = 0.0f;",
    "RingLimiter.*")
add("Integration.edges-bleed", "SynthesisLanes.cxx", "for (int pass = 0; pass < 2; ++pass) // as far", "for (int pass = 0; pass < 1; ++pass) // as far",
    "RingLimiter.*")
add("Integration.anisotropic-azimuths-from-the-axis", "LobeHarmonics.cxx", "std::polar(1.0, -k *", "std::polar(1.0, k *",
    "AnisotropicTable.Converges")
add("Integration.anisotropic-conjugate-forgotten", "LobeHarmonics.cxx", "(from % 2 != 0) != this->Lobes[lane].IsOdd", "from % 2 != 0",
    "AnisotropicTable.Converges|AnisotropicTable.ClothWithANapHasOnePeriod")
add("Integration.anisotropic-half-turn-forgotten", "RadianceTable.cxx", "(again ? 1.0 / this->Periods : 0.0)", "0.0",
    "AnisotropicTable.BrushedMetalInTwelveMegabytes|AnisotropicTable.Converges")
add("Material.anisotropic-always-half-a-turn", "HalfTurn.h", "return difference <= largest * probes;",
    "return true;", "AnisotropicTable.ClothWithANapHasOnePeriod")
add("Integration.anisotropic-axis-in-the-plane", "RadianceTable.cxx", "lobe.Axis.y * out.x - lobe.Axis.x * out.y, w", "0.0, w",
    "AnisotropicTable.Converges|AnisotropicTable.ClothWithANapHasOnePeriod")
add("Integration.filtered-lamps-without-cosine", "vtkFilteredRadianceIntegrator.cxx",
    "return i.z * f;", "return f;",
    "FilteredReference.Converges|Parity.FilteredIntegrator")
add("Rendering.sum-stays-when-the-view-changes", "SampleSums.cxx",
    "if (view.Key != viewKey ||", "if (", "Samples.BeginAnewWhenTheViewChanges")
add("Rendering.screenshot-of-a-part-of-the-sum", "SampleSums.cxx",
    "seen->GetReferenceCount() > 1", "seen->GetReferenceCount() > 2", "Samples.PicturesThatTheFilterReadsWait")
add("Rendering.sum-is-not-aborted", "SampleSums.cxx",
    "goesOn = !window->GetAbortRender();", "", "Samples.StopAndGoOn")
add("Rendering.abort-is-asked-for-now-and-then", "SampleSums.cxx",
    "window->InvokeEvent(vtkCommand::AbortCheckEvent);", "window->CheckAbortStatus();", "Samples.AskOftenWhetherToStop")
add("Rendering.cost-has-no-maximum", "PlanJob.cxx",
    "planner->SetMaximumCost(inputs.MaximumCost);", "", "Samples.AreDrawnWhileOneInteracts")
add("Rendering.sum-of-unequal-parts", "BRDFShader.cxx",
    "brdfPart.y - brdfPart.x", "1.0", "Samples.ShowTheSameOnPartsWithPlans")
add("Rendering.culled-actors-are-waited-for", "SampleSums.cxx",
    "!(this->Actor && this->Actor->GetRenderTimeMultiplier() > 0.0)", "false", "Samples.AreNotWaitedForOutOfView")
add("Rendering.samples-never-while-one-interacts", "MaterialDrawing.cxx",
    "!this->Sums.HasTime(renderer, actor, part)", "true", "Samples.AreDrawnWhileOneInteracts")
add("Rendering.samples-however-long-they-take", "SampleSums.cxx",
    "seconds < view.GetBudget()", "seconds < HUGE_VAL", "Samples.AreDrawnWhileOneInteracts")
add("Rendering.samples-of-a-subframe-twice", "BRDFShader.cxx",
    "ivec2(brdfPart.xy) *", "ivec2(brdfPart.x, brdfPart.y + 1.0) *", "Samples.ShowTheSameAsAllAtOnce")
add("Integration.filtered-keeps-samples-of-the-old-material", "vtkFilteredRadianceIntegrator.cxx",
    "impl.SamplesTime < this->BRDF->GetMTime() ||", "", "EveryMethod.FollowsItsInputs")
add("Integration.filtered-keeps-the-number-of-samples", "vtkFilteredRadianceIntegrator.cxx",
    "impl.Samples->GetNumberOfSamples() != this->NumberOfSamples)", "impl.Samples->GetNumberOfSamples() < 1)",
    "EveryMethod.FollowsItsInputs|FilteredReference.Converges")
add("Integration.filtered-level-of-the-sphere", "vtkFilteredRadianceIntegrator.cxx",
    "impl.Pyramid->GetLevel(4.0 * Pi)", "impl.Pyramid->GetLevel(16.0 * Pi)",
    "FilteredReference.Converges|FilteredIntegrator.MirrorShowsTheEnvironment")
add("Integration.filtered-adds-the-sharp-part-twice", "vtkFilteredRadianceIntegrator.cxx",
    "f * (1.0 - ReflectionSamples::GetSharpShare(f, sample.Limit))", "f",
    "FilteredIntegrator.BroadLobesSeeSmallPanels|Parity.FilteredIntegrator")
add("Integration.filtered-takes-anisotropic-materials", "vtkRadianceIntegrator.cxx",
    "if (!this->BRDF->IsIsotropic())", "if (this->BRDF == nullptr)", "EveryMethod.RefusesAndKeepsGoing")
add("Integration.samples-see-too-sharply", "vtkFilteredRadianceIntegrator.cxx", "-0.5 * std::log2(4.0 * Pi * density)",
    "-1.0 * std::log2(4.0 * Pi * density)",
    "FilteredReference.Converges|EveryMethod.TurnsWithItsEnvironment|FilteredIntegrator.RealSun")
add("Integration.samples-of-the-whole-material", "vtkFilteredRadianceIntegrator.cxx", "f * (GetSharpShare(f, limit) / density)",
    "f * (1.0 / density)", "EveryMethod.WhiteFurnaceIsTheDirectionalAlbedo")
add("Integration.samples-do-not-interpolate", "vtkFilteredRadianceIntegrator.cxx", "a.Weight + t * (b.Weight - a.Weight)",
    "a.Weight", "Parity.FilteredIntegrator|EveryMethod.WhiteFurnaceIsTheDirectionalAlbedo")
add("Integration.light-set-without-cosine", "vtkLightSetRadianceIntegrator.cxx",
    "above[k].z * values[k] * irradiances[k]", "values[k] * irradiances[k]",
    "ExactIntegrator.LambertUnderAConstantSkyHasAClosedForm|LightSetIntegrator.ConvergesToTheReference")
add("Integration.light-set-leaves-out-the-last-lights", "vtkLightSetRadianceIntegrator.cxx",
    "  addFound();\n  measuredbrdf::AddRGB", "  measuredbrdf::AddRGB", "ExactIntegrator.EqualsAPlainSum")
add("Integration.spread-is-the-concentration", "Lamps.cxx",
    "concentration > 0.0 ? 1.0 / concentration : 0.0", "concentration > 0.0 ? concentration : 0.0",
    "SoftLights.LowerTheErrorOfSharpLobesAndTables")
add("Integration.light-set-changes-unseen", "vtkLightSetRadianceIntegrator.cxx",
    "this->LightSet ? this->LightSet->GetMTime() : 0", "this->LightSet ? vtkMTimeType(1) : 0",
    "Mapper.RebuildsExactlyWhenItMust|Scene.LightsAreUploadedOnce")
add("Integration.light-set-copy-is-hard", "vtkLightSetRadianceIntegrator.cxx",
    "this->SetSoftLights(lights->SoftLights);", "", "RadianceMethods.CopiesHaveEveryProperty")
add("Integration.light-set-last-row", "Lamps.cxx",
    "(count + LightsPerRow - 1) / LightsPerRow", "count / LightsPerRow",
    "Mapper.ManyLightsAndHugeValues|Mapper.LightSetMatchesCpuPerPixel")
add("Integration.lights-cost-nothing", "vtkLightSetRadianceIntegrator.cxx",
    "PixelCosts::Light * this->NumberOfLights", "PixelCosts::Light",
    "Planner.CostsAreTimesATables|Planner.AnisotropicMaterialsGetTablesOrLightSets|Planner.EvaluateAllListsEveryMethod")
add("Integration.table-azimuth-mirrored", "LobePlacement.h",
    "this->Across = glm::dvec3(azimuth.x, 0.0, -azimuth.y);",
    "this->Across = glm::dvec3(-azimuth.x, 0.0, azimuth.y);",
    "TableReference.ErrorFallsWithSize|EveryMethod.TurnsWithItsEnvironment|Parity.TableIntegrator")
add("Integration.table-polar-unit", "LobePlacement.h", "this->Polar = std::atan2(sine, d.y) / pi;",
    "this->Polar = std::atan2(sine, d.y) / (2.0 * pi);", "TableReference.ErrorFallsWithSize|Parity.TableIntegrator")
add("Integration.table-profile-step", "LobePlacement.h", "GetTexel(profile, size * row + low + 1), exact - low);",
    "GetTexel(profile, size * row + low), exact - low);",
    "Parity.TableIntegrator|TableReference.ErrorFallsWithSize|TableIntegrator.Continuous")
add("Integration.hybrid-copy-without-angle", "vtkHybridRadianceIntegrator.cxx",
    "this->SetLightAngle(hybrid->LightAngle);", "", "RadianceMethods.CopiesHaveEveryProperty")
add("Integration.axes-jump", "LobeViews.cxx", "this->Views[k].Means.Delta = limited[k];", "",
    "LobeViews.AxesMoveSlowly")
add("Integration.axes-tilt-along-the-normal", "LobeViews.cxx",
    "std::clamp(0.5 * (above + below), -farthest, farthest)", "0.5 * (above + below)", "LobeViews.AxesMoveSlowly")
add("Core.shared-exponent-rounds-down", "Floats.h",
    "static_cast<std::uint32_t>(value * scale + 0.5f)", "static_cast<std::uint32_t>(value * scale)",
    "SharedExponent.ErrorIsAPartOfTheLargestComponent|SharedExponent.Ends")
add("Integration.octahedron-folded-once", "LobePlacement.h",
    "0.5 + 0.5 * (d.y < 0.0 ? side * (1.0 - glm::abs(glm::dvec2(p.y, p.x))) : p)", "0.5 + 0.5 * p",
    "OctahedralMap.ThereAndBack|OctahedralMap.HasNoSeam")
add("Integration.sharp-share-is-all", "LobeViews.cxx", "cell.Energy - energy / solidAngle * cell.SolidAngle",
    "cell.Energy", "LobeViews.TellsSharpFromBroad")
add("Integration.views-are-not-lifted", "vtkRadianceIntegrator.cxx", "LiftView(NormalizeAny(v), normal)",
    "NormalizeAny(v)", "EveryMethod.LowViewsAreLifted")

# Metrics

add("Metrics.percentile-share", "vtkRadianceMetrics.cxx", "GetPercentile(relative, 0.99)",
    "GetPercentile(relative, 0.9)", "RadianceMetrics.ByHand")
add("Metrics.percentile-of-own-radiance", "vtkRadianceMetrics.cxx", "GetPercentile(differences, 0.95)",
    "GetPercentile(relative, 0.95)", "RadianceMetrics.ByHand")
add("Metrics.percentile-without-fraction", "vtkRadianceMetrics.cxx",
    "values[k] + (at - static_cast<double>(k)) * (next - values[k])", "values[k]", "RadianceMetrics.ByHand")
add("Metrics.relmse-without-floor", "vtkRadianceMetrics.cxx", "r.square() + RelMSEFloor * mean * mean",
    "r.square()", "RadianceMetrics.ByHand")
add("Metrics.smape-is-not-symmetric", "vtkRadianceMetrics.cxx", "d / (x + r)", "d / (2.0 * r)",
    "RadianceMetrics.ByHand")
add("Metrics.rmse-without-root", "vtkRadianceMetrics.cxx", "std::sqrt(d.square().mean())", "(d.square().mean())",
    "RadianceMetrics.ByHand")
add("Metrics.coverage-inverted", "vtkRadianceMetrics.cxx", "coverage->GetComponent(k, 0) != 0.0",
    "coverage->GetComponent(k, 0) == 0.0", "PictureMetrics.CoverageAndSize")
add("Metrics.exposures-do-not-keep-the-largest", "PerceivedErrors.cxx",
    "largest = largest.max(ComputeFlip(", "largest = (ComputeFlip(",
    "PictureMetrics.HDRFlipAgreesWithTheAuthors|PictureMetrics.HDRFlipOfABlackBackground")
add("Metrics.negative-radiance-is-compared", "vtkRadianceMetrics.cxx", "!std::isfinite(value) || value < 0.0",
    "!std::isfinite(value)", "RadianceMetrics.BadInput")
add("Metrics.lab-blue", "PerceivedErrors.cxx", "200.0 * (t.row(1) - t.row(2));", "200.0 * (t.row(2) - t.row(1));",
    "PictureMetrics.AgreeWithOtherPrograms")
add("Metrics.ciede2000-rotation-sign", "PerceivedErrors.cxx", "+ rotation * c * h", "- rotation * c * h",
    "PictureMetrics.DeltaE2000OfThePublishedPairs")
add("Metrics.ciede2000-hue-mean", "PerceivedErrors.cxx", "std::abs(h1 - h2) > 180.0;",
    "std::abs(h1 - h2) > 360.0;", "PictureMetrics.DeltaE2000OfThePublishedPairs")
add("Metrics.flip-without-features", "PerceivedErrors.cxx", "color.pow(1.0 - (features / std::sqrt(2.0)).pow(FeatureExponent))",
    "color.pow(1.0 - 0.0 * features)",
    "PictureMetrics.AgreeWithOtherPrograms")
add("Metrics.flip-color-exponent", "PerceivedErrors.cxx", "ColorExponent = 0.7;", "ColorExponent = 0.8;",
    "PictureMetrics.AgreeWithOtherPrograms")
add("Metrics.bytes-are-not-decoded", "PictureErrors.cxx",
    "this->IsEncoded ? Decode(this->Show(background)) : this->Show(background)", "this->Show(background)",
    "PictureDifference.FiguresByHand|PictureDifference.AgreesWithOtherPrograms")
add("Metrics.background-shines-through-what-is-opaque", "PictureErrors.cxx", "(1.0 - this->Alpha) * background",
    "this->Alpha * background", "PictureDifference.AlphaOverBlackAndWhite")
add("Metrics.pictures-over-black-only", "PictureErrors.cxx", "metric.Compute(pair, 1.0)",
    "metric.Compute(pair, 0.0)", "PictureDifference.AlphaOverBlackAndWhite")
add("Metrics.masks-hide-black-only", "PictureErrors.cxx", "mask->GetComponent(k, 0) >= least",
    "mask->GetComponent(k, 0) > 0.0 * least", "PictureDifference.BorderAndMask")
add("Metrics.border-of-rows-is-compared", "PictureErrors.cxx", "inside.block(border, border, columns, rows)", "inside.block(border, 0, columns, height)",
    "PictureDifference.BorderOnAllSides")
add("Metrics.masked-pixels-show-in-their-neighbors", "PictureErrors.cxx", "if (pair.Compared[k] == 0.0)",
    "if (pair.Compared[k] > 2.0)", "PictureDifference.BorderAndMask")
add("Metrics.similarities-pass-below-the-threshold", "vtkPictureDifference.cxx",
    "this->Value >= threshold : this->Value <= threshold", "this->Value <= threshold : this->Value <= threshold",
    "PictureDifference.BorderAndMask")
add("Metrics.ssim-with-cut-windows", "PictureErrors.cxx", "MakeInside(pair.Width, pair.Height, SimilarityRadius)",
    "MakeInside(pair.Width, pair.Height, 0)", "PictureDifference.AgreesWithOtherPrograms")
add("Metrics.heat-map-of-one-scale", "vtkPictureDifference.cxx", "Find(this->MapMetric)->Brightest / (",
    "1.0 / (", "PictureDifference.HeatMap")
add("Metrics.reciprocity-of-the-same-pair", "vtkBRDFAnalysis.cxx", "this->BRDF->Evaluate(&o.x, &i.x, &swapped.x);",
    "this->BRDF->Evaluate(&i.x, &o.x, &swapped.x);", "BRDFAnalysis.ReciprocityErrorOfAKnownOne")
add("Metrics.negative-mass-of-positive-values", "vtkBRDFAnalysis.cxx", "glm::max(-value, 0.0)",
    "glm::max(value, 0.0)", "BRDFAnalysis.NegativeMassOfATable")
add("Metrics.albedos-in-degrees", "vtkBRDFAnalysis.cxx", "std::cos(ToRadians(angle))",
    "std::cos(0.5 * ToRadians(angle))",
    "BRDFAnalysis.Lambert|BRDFAnalysis.ReciprocityErrorOfAKnownOne|BRDFAnalysis.NegativeMassOfABasis|"
    "BRDFAnalysis.Arguments")
add("Metrics.failure-map-forgets-the-worst-azimuth", "vtkBRDFFailureMap.cxx",
    "cell.Azimuth = 360.0 * k / azimuths;", "cell.Azimuth = 180.0 * k / azimuths;",
    "BRDFFailureMap.FindsTheWorstAngles")
add("Metrics.failure-map-least-first", "vtkBRDFFailureMap.cxx", "cells[a].GetError() > cells[b].GetError()",
    "cells[a].GetError() < cells[b].GetError()", "BRDFFailureMap.FindsTheWorstAngles")

# Fitting

add("Fitting.pairs-without-cosine", "vtkBRDFFitter.cxx", "const double weight = o.z / density;",
    "const double weight = 1.0 / density;", "Fit.AlbedoIsTheHemispheres|Fit.FiguresAreWhatTheyAreSaidToBe")
add("Fitting.pairs-density", "vtkBRDFFitter.cxx", "half * difference / (4.0 * cosD)",
    "half * difference / (cosD)", "Fit.AlbedoIsTheHemispheres|Fit.FiguresAreWhatTheyAreSaidToBe")
add("Fitting.holes-count", "vtkBRDFFitter.cxx", "valid[0] >= 0.5 ? sample.Weight : 0.0",
    "valid[0] >= 0.5 ? sample.Weight : sample.Weight", "Fit.HolesInATableDoNotCount")
add("Fitting.cube-root-without-cosine", "vtkBRDFFitter.cxx", "std::cbrt(f * cosine + CubeRootOffset) -",
    "std::cbrt(f + CubeRootOffset) -", "Fit.FiguresAreWhatTheyAreSaidToBe|KnownFit.ComesBack")
add("Fitting.figures-of-the-fitted-pairs", "vtkBRDFFitter.cxx", "this->Seed, this->NumberOfSamples, std::max",
    "this->Seed, 0, std::max", "Fit.FiguresAreOfPairsThatTheFitDidNotSee")
add("Fitting.output-albedo-without-pi", "vtkBRDFFitter.cxx", "this->OutputAlbedo[c] = Pi * out[c] / cosines;",
    "this->OutputAlbedo[c] = out[c] / cosines;", "Fit.AlbedoIsTheHemispheres")
add("Fitting.residual-of-the-sum-of-channels", "vtkBRDFFitter.cxx", "sample.Weight * t * t / 3.0;",
    "sample.Weight * t * t;", "Fit.FiguresAreWhatTheyAreSaidToBe")
add("Fitting.history-of-squares", "vtkBRDFFitter.cxx", "mean = std::sqrt(mean);", "",
    "Fit.FiguresAreWhatTheyAreSaidToBe")
add("Fitting.relative-error-of-the-output", "vtkBRDFFitter.cxx", "total += projected * sample.F[c] * sample.F[c];",
    "total += projected * f[c] * f[c];", "Fit.RelativeErrorIsRelativeToTheInput")
add("Fitting.output-without-name", "vtkBRDFFitter.cxx", "result.BRDF->SetName(this->Input->GetName());", "",
    "Fit.OutputIsAMaterialLikeAnyOther")
add("Fitting.non-negative-gradient", "LinearLeastSquares.cxx", "gradient[k] < -tolerance;",
    "gradient[k] > tolerance;", "KnownFit.ComesBack")
add("Fitting.half-the-cost", "vtkLobeBRDFFitter.cxx", "push_back(squares)",
    "push_back(0.5 * squares)",
    "Fit.FiguresAreWhatTheyAreSaidToBe")
add("Core.never-regularized", "BasisFunctions.h",
    "std::sqrt(regularization * weight.sum() / (4.0 * Pi)) * l * (l + 1.0)", "0.0 * regularization * l",
    "Projector.MethodsMinimizeTheirOwnNorm|Projector.ErrorFallsWithTheOrder|"
    "Extrapolator.ProblemIsIllPosed")
add("Laboratory.negative-light-adds", "Acquisition.cxx", "stack.push_back(positive - negative);",
    "stack.push_back(positive + negative);", "Acquisition.IsTheInnerProduct")
add("Laboratory.photographs-of-one-sign", "Acquisition.cxx", "NumberOfPhotographs += hasNegative ? 2 : 1;",
    "NumberOfPhotographs += 1;",
    "Acquisition.IsTheInnerProduct|Acquisition.SameSeedSameBits|Acquisition.NoiseIsAveragedOverAzimuths")
add("Laboratory.isotropic-mean-sign", "Acquisition.cxx", "std::sin(angle) * other.",
    "-std::sin(angle) * other.", "Acquisition.IsTheInnerProduct")
add("Laboratory.noise-ignores-the-seed", "Acquisition.cxx", ", Random(options.Seed)", ", Random(1)",
    "Acquisition.SameSeedSameBits")
add("Laboratory.light-without-cosine", "Acquisition.cxx", "2.0 * Pi / azimuths * cosine);",
    "2.0 * Pi / azimuths);", "Acquisition.IsTheInnerProduct")
add("Fitting.pbr-roughness-power", "vtkPBRPropertyFitter.cxx", "return std::pow(roughness, 4);",
    "return std::pow(roughness, 2);", "PropertyFitter.FindsVTKsOwn|PropertyFitter.Gold")
add("Fitting.pbr-metals-are-diffuse", "vtkPBRPropertyFitter.cxx", "(1.0 - p[METALLIC]) * c;", "c;",
    "PropertyFitter.FindsVTKsOwn|PropertyFitter.Gold")

add("Fitting.multiplier-is-not-removed", "LinearLeastSquares.cxx", "this->Z -= this->Multiplier * solved.col(1);", "",
    "SimplexLeastSquares.NothingNearbyIsBetter")
add("Fitting.masked-photographs-count", "PhotographFit.cxx", "matrix -= rows.transpose() * rows;", "", "MaterialMapFitter.LeavesOutSpoiledPixels")
add("Fitting.saturated-pixels-count", "PhotographFit.cxx", "most >= set->GetSaturationLevel()", "most > set->GetSaturationLevel()",
    "MaterialMapFitter.IntegersAreSharesOfTheirLargest|MaterialMapFitter.LeavesOutSpoiledPixels")
add("Fitting.library-without-exchange-of-weights", "PhotographFit.cxx", "solution.Weights.dot(matrix * solution.Weights)",
    "solution.Weights.dot(right)", "MaterialMapFitter.FindsTheMaterialsOfALibraryAndTheirWeights")
add("Fitting.tables-without-refinement", "TableMaterials.cxx", "cells += smooth(target - model.array().log().matrix());",
    "", "MaterialMapFitter.FindsMaterialsAsTables")

# IO

add("IO.merl-green-and-blue", "MerlFile.cxx", "1.15 / 1500.0, 1.66 / 1500.0 }",
    "1.66 / 1500.0, 1.15 / 1500.0 }", "IOMerl.Reads")
add("IO.merl-negative-values-are-valid", "MerlFile.cxx", "finite && (!negative || noise);", "finite;",
    "IOMerl.Reads|IOMerl.CountsWhatIsNotFinite|IOTolerance.MerlNoiseAndPadding")
add("IO.merl-sizes-in-the-other-order", "MerlFile.cxx",
    "sizes = { dimensions[2], dimensions[1], dimensions[0] };",
    "sizes = { dimensions[0], dimensions[1], dimensions[2] };", "IOMerlRoundTrip.IsExact")
add("IO.merl-negative-tables-are-written", "MerlFile.cxx", "refused += valid && values[channel] < 0.0f;",
    "refused += 0;", "IOMerlRoundTrip.RefusesOtherTables")
add("IO.tensor-minor-version", "TensorFile.cxx", "major != 1 || minor != 0", "major != 1",
    "IOTensor.RefusesBadFiles")
add("IO.tensor-jacobian-ignored", "TensorFile.cxx", "tables.Jacobian = *field.Data == 1;",
    "tables.Jacobian = true;", "IOTensor.TakesTheJacobianFlag")
add("IO.tensor-zeros-are-noise", "TensorFile.cxx", "return value < 0.0f && value >= floor;",
    "return value <= 0.0f && value >= floor;", "IOTensor.Reads|IOTolerance.TensorDensitiesWithRoundingNoise")
add("IO.tensor-overlapping-fields", "TensorFile.cxx", "total += field.Bytes;",
    "total = field.Bytes;", "IOTensor.RefusesBadFields")
add("IO.mbsdf-gray-planes", "MbsdfFile.cxx", ": stored[k / 3]);", ": stored[k % stored.size()]);",
    "IOMbsdf.Reads")
add("IO.mbsdf-line-ends-of-dos", "MbsdfFile.cxx",
    "!line.empty() && line.back() == '\\r' ? line.size() - 1 : line.size()", "line.size()", "IOTolerance.MbsdfOfDosAndPadding")
add("IO.fits-scale-of-ngan", "FitFile.cxx", "{ 1.0, 1.15, 1.66 }", "{ 1.0, 1.66, 1.15 }", "IOFits.ScalesNgan")
add("IO.fits-byte-order-mark", "FitFile.cxx", "Text(SkipByteOrderMark(file.GetView()))", "Text(file.GetView())",
    "IOTolerance.FitsFromEditors")
add("IO.fits-low-with-schlick", "FitFile.cxx", "term->SetFresnelModelToDielectric();", "", "IOFits.ReadsLow")
add("IO.fits-twice-the-same-name", "FitFile.cxx", "if (!isNew)", "if (line < 0)",
    "IOFits.RefusesBadText")
add("IO.exr-red-and-blue", "ExrMaterialFile.cxx", '{ "R", "G", "B" }', '{ "B", "G", "R" }',
    "IOExr.ChannelsAreNamedForTheirColors")
add("IO.exr-half-floats-overflow", "ExrMaterialFile.cxx",
    "std::isfinite(value) && !rounded.back().isFinite()", "!std::isfinite(value) && !rounded.back().isFinite()",
    "IOHalfFloats.RefusesWhatIsTooLarge")
add("IO.exr-any-version", "ExrMaterialFile.cxx", "format != JsonFormat || version != JsonVersion",
    "format != JsonFormat", "IOExr.RefusesBadFiles")
add("IO.exr-terms-under-the-first", "ExrMaterialFile.cxx", "parts, depth + 1));\n    ++index;",
    "parts, depth + 1));", "IOExrRoundTrip.EveryModelComesBack")
add("IO.image-alpha-darkens", "ImageDecoder.cxx", '"oiio:UnassociatedAlpha", 1)', '"oiio:UnassociatedAlpha", 0)',
    "IOEnvironment.DecodesEveryFormat")
add("IO.image-floats-are-encoded", "ImageDecoder.cxx", "image.IsInteger && !SaysLinear(spec);",
    "!SaysLinear(spec);",
    "IOEnvironment.DecodesEveryFormat")
add("IO.image-upside-down", "vtkEnvironmentReader.cxx", "for (int y = 0; y < image.Height / 2; ++y)",
    "for (int y = 0; y < image.Height / 4; ++y)", "IOEnvironment.PutsTheTopRowLast")
add("IO.image-exposure-multiplies", "ImageFile.cxx", "Scale(1.0 / picture.Exposure)", "Scale(picture.Exposure)",
    "IOImageHeaders.RadianceIsDividedByAllExposures")
add("IO.image-orders-of-columns", "ImageFile.cxx", "turn % 4 == 1 || turn % 4 == 2", "turn % 4 == 1 || turn % 4 == 3",
    "IOImageHeaders.RadianceHasEightOrders|IOImageHeaders.OrientationTurns")
add("IO.image-white-is-not-adapted", "ImageFile.cxx",
    "GetAdaptation(GetWhite(from), GetWhite(Rec709)) *", "", "IOImageHeaders.ChromaticitiesBecomeRec709")
add("IO.image-tile-of-any-channels", "ImageFormats.cxx",
    "return std::ceil(std::max(channels, 1.0) / 4.0);", "return channels > 0.0 ? 1.0 : 1.0;",
    "IOImageHeaders.MemoryFollowsChannelsAndTiles")
add("IO.image-layer-without-a-name-last", "ExrImageFile.cxx", "layer.ChannelPrefix.empty() ? 1 : 2",
    "layer.ChannelPrefix.empty() ? 2 : 1", "IOImageHeaders.LayersAreChosenByName")
add("IO.image-deep-layers", "ExrImageFile.cxx", "!IsDeep(header) && it", "it",
    "IOImageHeaders.DeepAndSubsampledAreRefused")
add("IO.image-rgbe-run", "ImageFile.cxx", "bytes[isRun ? 0 : k]", "bytes[0]", "IOImageHeaders.RadianceHasRuns")
add("IO.image-exif-at-the-segment", "ImageFormats.cxx", "PeekOrientation(file, at + 10)",
    "PeekOrientation(file, at + 4)", "IOImageHeaders.OrientationTurnsJpeg")
add("IO.image-vtk-png-is-encoded", "VTKImageDecoder.cxx", "!saysGamma || std::lround(100.0 / gamma) != 100",
    "!saysGamma || saysGamma", "IOEnvironment.IntegersMayBeLinear")
add("IO.image-vtk-png-passes", "VTKImageDecoder.cxx", "row * (k % height)", "0 * (k % height)",
    "IOPicture.ExpandsPalettesOfInterlacedFiles")
add("IO.image-vtk-tiff-tiles", "VTKImageDecoder.cxx", "texel * (width * k + x)", "texel * (width * k)",
    "IOPicture.ReadsTiledTiff")
add("IO.offset-beyond-the-end", "FileBytes.cxx", "offset > size || count > size - offset",
    "count > size - offset", "IOTensor.RefusesBadFields|IOTensor.RefusesBadFiles|IOTensor.NamesTheFieldAndItsByte")
add("IO.padding-of-any-length", "FileBytes.cxx", "this->GetRemaining() <= most &&", "",
    "IOTolerance.MerlNoiseAndPadding|IOTolerance.MbsdfOfDosAndPadding|IOMerl.RefusesBadSizes")

add("IO.picture-upside-down", "ImageFile.cxx", "for (int y = file.Height - 1; y >= 0; --y)",
    "for (int y = 0; y < file.Height; ++y)", "IOPicture.KeepsValuesAsTheyAre|IOPhotographs.ReadsLists")
add("IO.picture-alpha-of-gray", "ImageFile.cxx", "texel[c == colors ? 3 : c]", "texel[c == 3 ? 3 : c]",
    "IOPicture.KeepsValuesAsTheyAre")
add("IO.picture-with-nan", "vtkPictureReader.cxx", "return !std::isfinite(value);", "return value > 1e38f;",
    "IOPicture.RefusesBadFiles")

add("IO.photograph-light-is-the-view", "vtkPhotographSetReader.cxx", "angles[2], angles[3], photograph.View",
    "angles[0], angles[1], photograph.View", "IOPhotographs.ReadsFoldersNamedAsBonnNamesThem")

# Planning

add("Planning.climb-never-ends", "PlanSearch.cxx", "(!found || task.All)", "true",
    "PlanSearch.ClimbsToTheCheapestWithinTheTolerance")
add("Planning.radiance-need-not-be-finite", "PlanSearch.cxx", "return std::isfinite(value);", "return true;",
    "PlanSearch.ClimbsToTheCheapestWithinTheTolerance")
add("Planning.memory-has-no-bound", "PlanSearch.cxx", "candidate.Bytes <= task.MaximumBytes;", "true;",
    "PlanSearch.PassesOverWhatDoesNotFit")
add("Planning.interaction-is-as-dear", "PlanSearch.cxx", "FindBest(plan.Candidates, task.Tolerance, InteractiveCost)", "plan.Choice",
    "PlanSearch.ClimbsToTheCheapestWithinTheTolerance")
add("Planning.pictures-have-the-mean", "PlanComparison.cxx", "GetLargestRatio(pictures, comparison.Pairs.Ratios) * (error", "(error",
    "PlanSearch.EstimatesSinglePictures")
add("Planning.reference-is-exact", "PlanComparison.cxx", "/ sum, comparison.ReferenceError);", "/ sum, 0.0);",
    "PlanComparison.AddsChanceAndTheReferencesError")
add("Planning.percentiles-without-weights", "PlanComparison.cxx", "left += share * weights[k];", "left += share;",
    "PlanComparison.AddsChanceAndTheReferencesError")
add("Integration.other-half-unmirrored", "FieldSynthesis.cxx", "getOut(places.Mirror, -m) = sign * (even - odd);",
    "getOut(places.Mirror, -m) = sign * (even + odd);", "FieldSynthesis.IsTheSumOverHarmonics")
add("Integration.tiles-without-the-lifted-rings", "RadianceTable.cxx", "LiftDarkRingsOfMap(&patch[0].x, Wide, Wide);", "",
    "TableTiles.NeedTheNodesAboutThem")
add("Integration.azimuths-turn-backwards", "RadianceTable.cxx", "gain * std::sin(angle)", "-gain * std::sin(angle)",
    "TableReference.*|TableIntegrator.*")
add("Planning.memory-decides-nothing", "PlanSearch.cxx", "(a.Cost == b.Cost && a.Bytes < b.Bytes)", "false",
    "Planner.EvaluateAllListsEveryMethod")
add("Planning.pictures-without-their-density", "PlanComparison.cxx", "std::max(std::sin(turned), LeastSine);", "1.0;",
    "PlanPictures.AreWhatCamerasSee")
add("Core.cache-lends-twice", "RecentlyUsed.h", "    this->Values.Remove(key);\n", "",
    "SharedCache.LendsToOneAndKeepsTheLastOnes")
add("Planning.sample-without-weights", "PlanSample.cxx", "weights[k] / draws[k]", "weights[k]",
    "PlanSample.LooksWhereMethodsDiffer")
add("Planning.sample-is-uniform", "PlanSample.cxx", "constexpr double ShareByDifference = 0.35;",
    "constexpr double ShareByDifference = 0.0;", "PlanSample.LooksWhereMethodsDiffer")
add("Planning.sample-leaves-the-dark-out", "PlanSample.cxx", "(1.0 - ShareByDifference - ShareByRadiance - ShareByWeight)",
    "0.0", "PlanSample.LeavesNothingOut")
add("Planning.lights-for-mirrors", "PlanReference.cxx", "return task.BRDF->IsIsotropic() &&",
    "return task.BRDF->IsIsotropic() ||", "PlanReference.KnowsItsErrorUnder*")
add("Planning.lights-without-error", "PlanReference.cxx", "error = own + fewer;",
    "error = 0.0;", "PlanReference.IsNearlyExact")
add("Planning.memory-without-the-material", "PlanSearch.cxx",
    "candidate.Bytes += static_cast<vtkIdType>(inputs.GetTextureBytes());", "",
    "Planner.TextureMemoryOfTheMaterial")
add("Planning.own-methods-stop-the-search", "PlanSearch.cxx",
    "if (task.IsAborted() || vtkRadianceMethods::IsBuiltIn(candidate.Method))",
    "if (task.IsAborted() || !candidate.Method.empty())", "RadianceMethods.WhatFailsIsLeftOutWithAWarning")
add("Planning.normals-over-half-a-turn", "PlanPairs.cxx", "const double turn = RadicalInverse(index, 3);",
    "const double turn = 0.5 * RadicalInverse(index, 3);", "PlanSample.CrowdsAboutLamps")
add("Planning.lamps-without-weights", "PlanPairs.cxx", "const double density = share * lamps.GetDensity(mirror);",
    "const double density = 0.0;", "PlanSample.CrowdsAboutLamps")
add("Planning.no-pairs-at-lamps", "PlanPairs.cxx", "constexpr double LampShare = 0.5;",
    "constexpr double LampShare = 0.0;", "PlanSample.CrowdsAboutLamps")

# Rendering

add("Rendering.texture-of-bytes-is-linear", "TextureEnvironment.cxx",
    "(texture->GetUseSRGBColorSpace() || hasHarmonics)", "texture->GetUseSRGBColorSpace()", "TextureEncoding.IsAsVtkTakesIt")
add("Rendering.stand-in-of-few-rows", "SharedIntegrators.cxx",
    "{ 65, 8, 8 }", "{ 33, 8, 8 }", "Background.StandInsForMirrorLikeMaterialsUnderPanels")
add("Rendering.stand-in-is-the-material", "SharedIntegrators.cxx",
    "vtkSmartPointer<vtkBRDF>::Take(this->Material->NewQuickRenderable());",
    "vtkSmartPointer<vtkBRDF>(this->Material->GetRenderable());",
    "Background.ACoarseFormForShadersUntilThePlan")
add("Rendering.stand-in-form-for-nobody", "SharedIntegrators.cxx", "made->Material = material;",
    "made->Material = material;\n  made->GetRenderable();", "StandIns.NoFormWhereNoLightNeedsIt")
add("Rendering.plan-learns-of-no-light", "PlanJob.cxx",
    "found->WithShaderInputs = found->WithShaderInputs || inputs.WithShaderInputs;", "",
    "StandIns.LightsThatComeWhileAPlanIsMade")
add("Rendering.failed-plan-begun-again", "MapperPlans.cxx", "this->Adopt(wanted, done ? job : nullptr);",
    "this->Adopt(job->GetPlan() ? wanted : PlanInputs(), job);",
    "StandIns.PlansThatFail")
add("Rendering.failed-stand-in-tried-again", "ShaderTextures.cxx", "if (time <= this->FailureTime)",
    "if (time < 0 * this->FailureTime)", "StandIns.ThoseThatFailAreTriedOnce")
add("Rendering.plans-beside-stand-ins", "PlanJob.cxx", "this->Holds == 0 && this->Running < this->Limit",
    "this->Running < this->Limit", "SideBySide.HeldUntilSomebodyWaits")
add("Rendering.wait-for-what-is-held", "PlanJob.cxx", "(this->Waiters > 0 ? this->Running <= this->Limit",
    "(this->Waiters > 99 ? this->Running <= this->Limit", "SideBySide.HeldUntilSomebodyWaits")
add("Material.cells-of-one-side-only", "HalfDifferenceFill.cxx",
    "const bool mirrored = !reciprocal && IsMirroredAtH(input);", "const bool mirrored = !reciprocal;",
    "HalfDifferenceFill.EachCellHoldsItsOwnValue")
add("Material.cells-slide-too-early", "HalfDifferenceFill.cxx", "cell.IsSlid ? value : nullptr",
    "cell.IsSlid || y > 2 ? value : nullptr", "HalfDifferenceFill.EachCellHoldsItsOwnValue")
add("Material.resampled-from-seven-corners", "VolumeInterpolation.h", "cell + axis.Second, weight * axis.Weight, use);", "cell + axis.First, weight * axis.Weight, use);",
    "Resampler.ErrorFallsAndIsReported")
add("Material.quick-for-another-tolerance", "vtkResampledBRDF.cxx", "made.Table && made.Tolerance == this->ResamplingTolerance;",
    "made.Table;", "QuickTables.StandInUntilTheRealOneIsMade")
add("Integration.quick-is-slow", "vtkTableRadianceIntegrator.cxx", "std::make_shared<Precomputation>(isQuick)",
    "std::make_shared<Precomputation>()", "Tables.QuickOnesEvaluateLittle")
add("Rendering.plan-key-without-pixels-of-the-light", "PlanJob.h", "this->Environment, this->PixelsTime,",
    "this->Environment, vtkMTimeType(0),", "Background.EverythingThatCountsBeginsAnother")
add("Rendering.plan-key-without-tolerance", "PlanJob.h", "this->PixelsTime, this->Tolerance,",
    "this->PixelsTime, 0.0,", "Background.EverythingThatCountsBeginsAnother")
add("Rendering.plan-without-tolerance", "PlanJob.cxx", "planner->SetErrorTolerance(inputs.Tolerance);",
    "", "Background.EverythingThatCountsBeginsAnother|Auto.PlansOnce")
add("Rendering.plan-bridges-changed-pixels", "MapperPlans.cxx",
    "made.Environment->GetPixelsMTime() == made.PixelsTime", "made.PixelsTime > 0",
    "Background.ChangedPixelsAreNotBridgedByAPlanOfThem")
add("Rendering.back-is-seen", "VisibleSurface.cxx", "glm::dot(point.Normal, direction) > 0.0 ?",
    "glm::dot(point.Normal, direction) < 0.0 ?", "Visible.ConesShowTheirFlank|Visible.SpheresCoverTheirDiscs")
add("Rendering.what-is-outside-counts", "VisibleSurface.cxx", "low = glm::clamp(low, -1.0, 1.0);", "",
    "Visible.OnlyWhatIsInThePictureCounts")
add("Rendering.left-tables-go-on", "PlanJob.cxx", "return this->Planner->GetAbort(); });", "return false; });",
    "CurrentPlan.LeavesResamplingInTheMiddle")
add("Rendering.left-jobs-are-kept", "PlanJob.cxx", "owned.reset();", "",
    "Background.ItsEndLeavesNothing")
add("Rendering.left-plans-go-on", "PlanJob.cxx", "job->Planner->SetAbort(!job->Done);", "",
    "Background.AChangeStopsWhatIsInTheMaking")
add("Rendering.changed-materials-are-not-redrawn", "MaterialSettings.cxx", "add(this->BRDF);", "",
    "Mapper.RebuildsExactlyWhenItMust|Scene.RedrawTimeFollowsAppearance")
add("Rendering.largest-tolerance", "MaterialSettings.h", "LargestTolerance = 1.0;",
    "LargestTolerance = 10.0;", "Auto.TolerancesAreClampedWithAWarning")
add("Rendering.selection-plans", "RenderPassQueries.cxx", "if (renderer->GetSelector())", "if (!renderer)",
    "Views.SelectionNeedsNoPlans")
add("Rendering.hidden-lines-plan", "RenderPassQueries.cxx", "return mask[0] || mask[1] || mask[2];", "return true;",
    "Views.HiddenLinesNeedNoPlans")
add("Rendering.cube-faces-upside-down", "TextureEnvironment.cxx", "low < high; low += row",
    "high < low; low += row", "Mapper.CubeMapTexture")
add("Rendering.textures-never-repeat", "ShaderTextures.cxx", "texture.Repeat[axis] ? vtkTextureObject::Repeat",
    "texture.Repeat[axis] ? vtkTextureObject::ClampToEdge", "Parity.Tables|Parity.TableIntegrator")
add("Rendering.padding-is-transparent", "ShaderTextures.cxx", "triples[k + 2], 1.0f });",
    "triples[k + 2], 0.0f });", "Parity.Tables",
    equivalent="shaders read only red, green and blue of textures that have no fourth component")
add("Rendering.hard-lights-get-soft-textures", "ShaderTextures.cxx",
    "brdf, brdf->GetMTime(), softLights, window,", "brdf, brdf->GetMTime(), true, window,",
    "Mapper.SoftLightsOfTablesCostHardOnesNothing")
add("Rendering.block-indices-from-one", "CompositeBlocks.cxx", "index = this->Next++;",
    "index = ++this->Next;", "Composite.MaterialsOfBlocks")
add("Rendering.block-behind-the-last", "CompositeBlocks.cxx", "if (index >= this->Next)",
    "if (index > this->Next)", "Composite.MissingBlocksAreSaidOnce")
add("Rendering.blocks-do-not-inherit", "CompositeBlocks.cxx", "childName, material);",
    "childName, { this->Settings.BRDF, false });", "Composite.MaterialsOfBlocks")

add("Rendering.scene-lights-stay", "MaterialDrawing.cxx",
    '(this->Settings->UseSceneLights ? "" : "/environment only")', "std::string()", "MapperShading.SceneLights")

# Sources

add("Sources.lobe-without-the-cosine", "vtkBRDFLobeSource.cxx", "const glm::dvec3 radiance = f * i.z;",
    "const glm::dvec3 radiance = f;", "LobeSource.PointsLie")
add("Sources.lobe-about-the-light", "vtkBRDFLobeSource.cxx", "{ -i.x, -i.y, i.z }", "{ i.x, i.y, i.z }",
    "LobeSource.PointsLie")
add("Sources.lobe-open-at-its-seam", "vtkBRDFLobeSource.cxx", "(k + 1) % circular", "k + 1",
    "LobeSource.TheSurface")
add("Sources.slice-range-ends-early", "vtkBRDFSliceSource.cxx", "static_cast<double>(index) / (number - 1)",
    "static_cast<double>(index) / number", "SliceSource.RowsHold")
add("Sources.phi-h-forgotten", "MaterialSource.h", "o = glm::rotateZ(o, ToRadians(phiH));",
    "", "SliceSource.RowsHold")
add("Sources.below-the-horizon-is-valid", "MaterialSource.h", "i.z > 1e-9 && o.z > 1e-9", "i.z > 1e-9",
    "SliceSource.RowsHold|ImageSource.Pixels")
add("Sources.image-at-pixel-corners", "vtkBRDFImageSource.cxx", "(static_cast<double>(extent[0] + k % width) + 0.5)",
    "static_cast<double>(extent[0] + k % width)", "ImageSource.Pixels")
add("Sources.material-changes-unseen", "MaterialSource.h", "std::max(time, brdf->GetMTime())", "time",
    "Sources.FollowTheirMaterial")

# Visibility

add("Visibility.edges-of-one-sign", "SurfaceTracer.cxx", "(u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0",
    "(u < 0.0 || v < 0.0 || w < 0.0) || (u > 0.0", "SurfaceTracer.IsWatertight|SurfaceTracer.DescribesTheHit")
add("Visibility.offset-to-the-other-side", "VisibilityTask.cxx", "return point.Origin + side", "return point.Origin - side",
    "SurfaceVisibility.TheOtherSideHasItsOwnSky|SurfaceVisibility.BlocksHideOneAnother")
add("Visibility.strips-turn-over", "SurfacePoints.h", "ids[n - 1 + n % 2],",
    "ids[n - 1 + 0 % 2],", "SurfaceTracer.ReadsStrips")
add("Visibility.matrix-by-columns", "SurfaceTracer.cxx", "m[4 * c + 2] * p.z + m[4 * c + 3]",
    "m[4 * c + 2] * p.z + m[12 + c]", "SurfaceTracer.DescribesTheHit")
add("Visibility.farthest-triangle", "SurfaceTracer.cxx", "  ray.Most = t;\n", "",
    "SurfaceTracer.FindsTheNearestTriangle")

add("Visibility.points-below-the-facet", "vtkTracedScene.cxx", "return from.Position + this->Tracer->GetOffset()",
    "return from.Position - this->Tracer->GetOffset()", "Traced.TwoSidedSheets")
add("Visibility.no-lift-above-facets", "vtkTracedScene.cxx", "point.Position += lift;", "",
    "Traced.ConvexSurfacesHideNothing")
add("Integration.traced-one-bounce-too-many", "vtkTracedRadianceIntegrator.cxx", "for (int k = 0; k < bounces; ++k)",
    "for (int k = 0; k <= bounces; ++k)", "Traced.BowlsAndFurnaces")
add("Integration.traced-density-without-cosine", "vtkTracedRadianceIntegrator.cxx",
    "shares[ByCosine] * draw.Local.z / Pi", "shares[ByCosine] / Pi", "Traced.BowlsAndFurnaces|Traced.AgreesWithMitsuba")
add("Integration.sky-density-of-the-whole-map", "vtkTracedRadianceIntegrator.cxx", "(2.0 * Pi * Pi * cosine)",
    "(4.0 * Pi * Pi * cosine)", "Traced.WaysToTraceAgree|Traced.ThinSlits")
add("Planning.occlusion-tolerance-adds-up", "vtkOcclusionPredictor.cxx",
    "tolerance * tolerance - planError * planError", "tolerance * tolerance + planError * planError",
    "OcclusionPredictor.Decision")
add("Planning.occlusion-relative-to-open-light", "vtkOcclusionPredictor.cxx", "traced.Reference = radiance;",
    "traced.Reference = open;", "OcclusionPredictor.ABowl")

# Shaders

add("Shaders.views-are-lifted-too-far", "vtkBRDFCommon.glsl", "const float minimum = 0.02;",
    "const float minimum = 0.05;", "MapperShading.GrazingViews")
add("Shaders.left-handed-frame", "vtkBRDFCommon.glsl", "return mat3(p / l, cross(n, p / l), n);",
    "return mat3(p / l, cross(p / l, n), n);",
    "MapperShading.TheTangentsDirectionCounts|Scene.TangentsFollowTheActor")
add("Shaders.left-half-of-the-turn", "vtkBRDFCommon.glsl", "q = v.x >= 0.0 ? q : 2.0 - q;", "", "Parity.Tables")
add("Shaders.schlick-fourth-power", "vtkBRDFCommon.glsl", "return m2 * m2 * m;", "return m2 * m2;",
    "Parity.ClosedForms")
add("Shaders.half-difference-sign", "vtkBRDFCommon.glsl", "dot(p, i.xy) - s * i.z,", "dot(p, i.xy) + s * i.z,",
    "Parity.Tables")
add("Shaders.log-cosine-series", "vtkBRDFCommon.glsl", "s * (0.5 + s * (1.0 / 3.0", "s * (0.25 + s * (1.0 / 3.0",
    "Parity.ClosedForms")
add("Shaders.half-vector-spread-factor", "vtkBRDFCommon.glsl", "return spread / (4.0 *", "return spread / (2.0 *",
    "Parity.SoftLights")
add("Shaders.validity-ignored", "vtkBRDFCommon.glsl", "max(v.rgb / v.a, vec3(0.0))", "max(v.rgb, vec3(0.0))",
    "Parity.Tables|Parity.EmbeddedMeasurement|Parity.RealFiles")
add("Shaders.display-texel-is-linear", "vtkBRDFCommon.glsl", "vec3(1.0 / 2.2)), texel.a)", "vec3(1.0)), texel.a)",
    "Scene.TexturesMultiplyLinearly")
add("Shaders.ashikhmin-shirley-exponents", "vtkBRDFAshikhminShirley.glsl",
    "brdfHalfVector(i, o), brdfExponentsINSTANCE.xy, 1.0)", "brdfHalfVector(i, o), brdfExponentsINSTANCE.yx, 1.0)",
    "Parity.ClosedForms")
add("Shaders.ashikhmin-shirley-cosine", "vtkBRDFAshikhminShirley.glsl", "(hd * max(i.z, o.z))", "(hd * i.z)",
    "Parity.ClosedForms")
add("Shaders.blinn-phong-soft-normalization", "vtkBRDFBlinnPhong.glsl",
    "((n + 2.0) / (brdfExponentINSTANCE + 2.0)) *", "", "Parity.SoftLights")
add("Shaders.basis-azimuth", "vtkBRDFBasis.glsl", "o.x * i.y - o.y * i.x", "o.y * i.x + o.x * i.y",
    "Parity.SphericalHarmonics")
add("Shaders.basis-coefficients-of-the-view-before", "vtkBRDFBasis.glsl", "brdfCoefficientViewINSTANCE = o;",
    "brdfCoefficientViewINSTANCE = o.xyz + vec3(1.0);", "Parity.SphericalHarmonics|Parity.BasesAfterEachOther",
    equivalent="the coefficients of every light are fetched anew, which is slower and no other picture")
add("Shaders.basis-is-not-clamped", "vtkBRDFBasis.glsl", "return max(sum, vec3(0.0)) /", "return sum /",
    "Parity.NegativeSumsAreZeroForEachLight")
add("Shaders.grazing-views-are-not-lifted", "vtkBRDFBegin.glsl", "brdfLiftView(brdfView * brdfFrame)",
    "brdfView * brdfFrame", "MapperShading.GrazingViews")
add("Rendering.environment-does-not-turn", "TextureEnvironment.cxx", "glm::transpose(own) * glm::transpose(axes);",
    "glm::transpose(own);",
    "Mapper.RotatingEverythingChangesNothing")
add("Shaders.directional-light-without-cosine", "vtkBRDFDirectionalLight.glsl", "* radiance * brdfLight.z;",
    "* radiance;", "Mapper.SceneLights")
add("Rendering.created-light-shines", "RenderPassQueries.cxx",
    "light->GetSwitch() && IsCreated(light, renderer)", "IsCreated(light, renderer) && number < 0", "MapperShading.LightThatVTKCreated")
add("Rendering.created-light-is-never-on", "RenderPassQueries.cxx",
    "isLit ? lights->GetNextLight(it) : nullptr", "lights->GetNextLight(it)",
    "MapperShading.LightThatVTKCreated")
add("Rendering.left-out-light-is-no-part-of-the-key", "MaterialShading.cxx",
    "std::to_string(this->FindSuperfluousLight(ren))", 'std::string("x")', "MapperShading.LightThatVTKCreated")
add("Shaders.headlight-without-cosine", "vtkBRDFHeadlight.glsl", "* radiance * brdfLight.z;", "* radiance;",
    "MapperShading.HeadlightOnATiltedPlane")
add("Shaders.spot-exponent-ignored", "vtkBRDFPositionalLight.glsl", "pow(brdfConeLIGHT, lightExponentLIGHT)", "1.0",
    "MapperShading.SpotOffItsAxis")
add("Shaders.linear-attenuation-without-distance", "vtkBRDFPositionalLight.glsl",
    "lightAttenuationLIGHT.y * brdfDistanceLIGHT +", "lightAttenuationLIGHT.y +", "MapperShading.SpotOffItsAxis")
add("Shaders.scalars-made-linear-by-two", "vtkBRDFEnd.glsl", "vec3(0.0)), vec3(2.2));", "vec3(0.0)), vec3(2.0));",
    "MapperShading.HalfGrayScalars")
add("Shaders.green-without-guard", "vtkBRDFEnd.glsl", "brdfRadiance.g > 0.0 ? min(brdfRadiance.g, 3e10) : 0.0",
    "min(brdfRadiance.g, 1e9)", "MapperShading.NegativeLightsEndAtZero")
add("Shaders.irradiance-without-its-scale", "vtkBRDFEnvironmentTable.glsl",
    "vec3 irradiance = brdfTableIrradianceScaleINSTANCE *", "vec3 irradiance = 1.0 *",
    "LightUnits8Bit.OfMaterialMaps|Parity.TableIntegrator")
add("Shaders.encoded-twice", "vtkBRDFEnd.glsl", "pow(brdfRadiance, vec3(1.0 / 2.2))",
    "pow(brdfRadiance, vec3(1.0 / 2.4))", "Mapper.SceneLights|MapperShading.HalfGrayScalars")
add("Shaders.filtered-last-view", "vtkBRDFEnvironmentFiltered.glsl", "float last = 0.887158;", "float last = 0.95;",
    "Parity.FilteredIntegrator")
add("Shaders.octahedron-lower-half", "vtkBRDFEnvironmentPyramid.glsl", "d.z < 0.0 ? 1.0 - uv.yx : uv;",
    "d.z < 0.0 ? 1.0 - uv : uv;", "Parity.FilteredIntegrator")
add("Shaders.pyramid-levels-are-not-mixed", "vtkBRDFEnvironmentPyramid.glsl", "level + 1.0), lod - level)",
    "level + 1.0), 0.0)", "Parity.FilteredIntegrator")
add("Shaders.table-azimuth-slices", "vtkBRDFEnvironmentTable.glsl", "fract(psi) * (slices - 1.0)",
    "fract(psi) * (slices - 2.0)", "Parity.TableIntegrator")
add("Shaders.table-floor-of-another-part", "vtkBRDFEnvironmentTable.glsl", "texelFetch(brdfTableProfileINSTANCE, ivec2(view, 1), 0)", "texelFetch(brdfTableProfileINSTANCE, ivec2(view, 0), 0)",
    "Parity.TableIntegrator")
add("Integration.shader-profile-of-the-view-before", "RadianceTable.cxx", "= k / (ProfileTexels - 1.0)",
    "= (k - 0.5) / (ProfileTexels - 1.0)", "ShaderProfile.HoldsWhatIsInterpolated")
add("Material.shirley-lanes-of-one-exponent", "vtkAshikhminShirleyBRDF.cxx", "exponents[1] * ySquare", "exponents[0] * ySquare",
    "ManyLights.OfAshikhminShirley")
add("Material.lane-logarithm-near-zero-everywhere", "LaneMath.h", "return s > 0.25f ? large : small;", "return small;",
    "LaneMath.PowersAreThoseOfDoublePrecision")
add("Integration.lanes-of-whoever-derives", "LightLanes.cxx", "brdf && typeid(*brdf) == typeid(BRDF)", "dynamic_cast<BRDF*>(brdf)",
    "LightLanes.AreTheMaterial")
add("Integration.lanes-of-the-last-term", "LightLanes.cxx", "term > 0 ? sum[k] : 0.0f", "0.0f",
    "LightLanes.AreTheMaterial")
add("Integration.core-weights-of-another-channel", "RadianceCore.cxx", "static_cast<float>(weights[c])", "static_cast<float>(weights[0])",
    "Parity.FactoredIntegrator")
add("Shaders.lamps-parts-by-the-count", "vtkBRDFEnvironmentLamps.glsl", "floor(whole.a / COUNT_BASE)", "whole.a - COUNT_BASE * floor(whole.a / COUNT_BASE)",
    "Parity.HybridOfWideLamps")
add("Integration.lamps-count-one-part-more", "Lamps.cxx", "CountBase * start + std::max", "CountBase * start + 1 + std::max",
    "Parity.HybridOfWideLamps")
add("Integration.lamps-window-with-an-edge", "Lamps.h", "x < 1.0 ? root * root : 0.0", "x < 1.0 ? 1.0 : 0.0",
    "LampWindow.EndsWithoutAnEdge|HybridLamps.NothingShowsWhereTheWindowEnds")
add("Integration.lamps-in-the-table-again", "LobeHarmonics.cxx", "1.0 - LampWindow::GetWeight(MakeDirection", "1.0 - 0.0 * LampWindow::GetWeight(MakeDirection",
    "HybridLamps.AddUpToTheLamps")
add("Integration.lamps-as-points", "vtkHybridRadianceIntegrator.cxx", "lamps ? lamps->GetSpread(", "lamps ? 0.0 * lamps->GetSpread(",
    "HybridLamps.AreAreasForNarrowLobes")
add("Shaders.lamps-of-one-part", "vtkBRDFEnvironmentLamps.glsl", "isWhole || part >=", "isWhole || part + 8.0 >=",
    "Parity.HybridOfWideLamps")
add("Integration.lamps-have-no-parts", "MaterialPrecomputation.cxx", "LampBRDF::IsWidthSeen(views, spread)", "LampBRDF::IsWidthSeen(views, 0.0 * spread)",
    "HybridLamps.HaveParts")
add("Integration.lamps-of-resampled-materials", "vtkHybridRadianceIntegrator.cxx", "!this->BRDF->IsRenderable()", "this->BRDF == nullptr",
    "HybridLamps.MaterialsWithoutGLSLTakeTheTableOfMeans")
add("Integration.lamps-parts-are-the-first", "Lamps.cxx", "    first += count;\n", "", "Parity.HybridOfWideLamps")
add("Integration.lamp-lobes-of-half-a-turn", "Lamps.cxx", "ClampedNeighbors(2.0 * std::abs(u.x)", "ClampedNeighbors(std::abs(u.x)",
    "LampBRDF.IsTheMeanOverALamp")
add("Integration.lamps-seen-from-the-horizon", "LobeViews.cxx", "GetAngle(k) <= farthest", "GetAngle(k) <= Pi",
    "LampBRDF.IsForLobesAsNarrowAsLamps")
add("Lighting.lamps-of-one-texel-are-points", "ExtractedEmitters.cxx", "0.5 * (row * row + column * column) / 6.0", "0.0",
    "ExtractedEmitters.LampsAreOneLightEach|HybridLamps.AreAreasForNarrowLobes")
add("Shaders.lamp-lobes-of-half-a-turn", "vtkBRDFEnvironmentLampLobe.glsl", "u.x = 2.0 * abs", "u.x = abs", "Parity.HybridOfWideLamps")
add("Integration.lamps-lambert-part-twice", "Lamps.cxx", "(f - lambert) * part.Irradiance", "f * part.Irradiance",
    "HybridLamps.AddUpToTheLamps|Parity.HybridIntegrator")
add("Shaders.lamps-only-the-first", "vtkBRDFEnvironmentLamps.glsl", "while (found != 0)", "while (false)",
    "Parity.HybridOfManyLamps")
add("Shaders.lamps-of-the-next-row", "vtkBRDFEnvironmentLamps.glsl", "+ part), int(row))", "+ 1.0 - part), int(row))",
    "Parity.HybridIntegrator|Parity.HybridOfManyLamps")
add("Material.angle-basis-patches-begin-at-zero", "vtkAngleBasisBRDF.cxx",
    "std::atan2(d.y, d.x) / (2.0 * Pi) * count + 0.5", "std::atan2(d.y, d.x) / (2.0 * Pi) * count", "IOBsdfXml.Reads")
add("Material.tensor-tree-bits-reversed", "vtkTensorTreeBRDF.cxx", "std::size_t(1) << axis;",
    "std::size_t(1) << (axes - 1 - axis);", "IOBsdfXml.ReadsTensorTrees")
add("Material.btdf-light-on-the-other-side", "vtkBTDF.cxx", "const int side = i[2] > 0.0 ? FRONT : BACK;",
    "const int side = o[2] > 0.0 ? FRONT : BACK;", "Transmission.IsBetweenTheSides")
add("Material.btdf-other-side-not-exchanged", "vtkBTDF.cxx", "Values{ other, true }", "Values{ other, false }",
    "Transmission.SumsMatricesExactly|IOTransmission.UsesReciprocityForTheMissingSide")
add("Material.btdf-sum-not-through-the-surface", "vtkAngleBasisBRDF.cxx", "(overView ? Pi : 0.0)", "(overView ? 0.0 : 0.0)",
    "Transmission.SumsMatricesExactly|IOTransmission.TransmittanceIsTheMatrixSum",
    equivalent="a turn maps the patches of a ring on one another: only rounding at the borders of odd counts could tell")
add("Material.btdf-patches-alike", "vtkAngleBasisBRDF.cxx", "std::pow(std::sin(outer), 2.0) - std::pow(std::sin(inner), 2.0)", "std::sin(outer) - std::sin(inner)",
    "IOTransmission.TransmittanceIsTheMatrixSum")
add("IO.bsdf-xml-sides-of-transmission", "BsdfXmlFile.cxx", "&lit == &side ? vtkBTDF::FRONT : vtkBTDF::BACK",
    "&lit != &side ? vtkBTDF::FRONT : vtkBTDF::BACK", "IOTransmission.ReadsMatrices|IOTransmission.AgreesWithRadiance")
add("IO.bsdf-xml-keeps-the-last-transmission", "vtkBRDFReader.cxx",
    "this->Transmission = content.Transmission;\n      this->Notes", "this->Notes", "IOTransmission.IsOfferedBesideReflection")
add("Sources.lobe-of-transmission-above", "vtkBRDFLobeSource.cxx", "(up.x, up.y, -up.z)", "(up)",
    "LobeSource.TransmissionIsBelowTheSurface")
add("Sources.lobe-of-transmission-inside-out", "vtkBRDFLobeSource.cxx", "first, first > 0, cells",
    "first, false, cells", "LobeSource.TransmissionIsBelowTheSurface")
add("IO.bsdf-xml-rows-as-columns", "BsdfXmlFile.cxx", 'if (IsSameWord(this->Structure, "Rows"))',
    'if (IsSameWord(this->Structure, "Never"))', "IOBsdfXml.Reads")
add("Material.warp-folds-the-other-way", "vtkAdaptiveWarpBRDF.cxx", "along.x + along.y < 0.0", "along.x + along.y > 0.0",
    "AnisotropicWarp.ReadsReducedFiles")
add("Integration.anisotropic-table-keeps-lamps", "vtkTableRadianceIntegrator.cxx",
    "const auto harmonics = getHarmonics(this->Rest);", "const auto harmonics = getHarmonics(nullptr);",
    "Hybrid.AnisotropicMaterialsUnderLamps")
add("Shaders.anisotropic-table-reaches-the-next-azimuth", "vtkBRDFAnisotropicTable.glsl",
    "clamp(u.y * rows, 0.5, rows - 0.5)", "u.y * rows", "Parity.AnisotropicTables")
add("Shaders.table-azimuth-range", "vtkBRDFHalfDifference.glsl", "u.x *= brdfTurnsINSTANCE;", "", "Parity.Tables")
add("Shaders.soft-table-levels-are-not-mixed", "vtkBRDFHalfDifferenceSoft.glsl", "level - float(first));", "0.0);",
    "Parity.SoftTables")
add("Shaders.mirrored-half-turn", "vtkBRDFIncidentOutgoing.glsl", "phi = brdfTurnsINSTANCE > 1.5 ? abs(phi) : phi;",
    "", "Parity.Tables")
add("Shaders.cosine-weight-ignored", "vtkBRDFIncidentOutgoing.glsl", "mix(1.0, o.z, brdfCosineWeightedINSTANCE)",
    "mix(1.0, i.z, brdfCosineWeightedINSTANCE)", "Parity.Tables|Parity.RealFiles")
add("Shaders.lambert-without-pi", "vtkBRDFLambert.glsl", "vec3(0.0)) / brdfPi;", "vec3(0.0));", "Parity.ClosedForms")
add("Shaders.light-set-without-cosine", "vtkBRDFLightSet.glsl", "irradiance * i.z;", "irradiance;",
    "Mapper.LightSetMatchesCpuPerPixel")
add("Shaders.distribution-denominator", "vtkBRDFDistribution.glsl", "i.z + o.z - i.z * o.z", "i.z + o.z",
    "Parity.Tables")
add("Shaders.tangent-axis-across", "vtkBRDFTangentAxis.glsl", "vec3(0.0, 1.0, 0.0) * envMatrix",
    "vec3(1.0, 0.0, 0.0) * envMatrix", "MapperShading.TheTangentsDirectionCounts")

# Export: what the tool exports with

MODELS = "ExportModels.AgreeWithOtherImplementations"
add("Export.ggx-distribution-power", "Lobes.h", "return 1.0 / (Pi * alphaX * alphaY * d * d);",
    "return 1.0 / (Pi * alphaX * alphaY * d);", MODELS)
add("Export.separable-shadowing", "Lobes.h", "return 1.0 / (part(ndl) * part(ndv));", "return 1.0 / (part(ndl) * part(ndl));",
    MODELS)
add("Export.turned-the-other-way", "Lobes.h", "return { c * v.x + s * v.y, c * v.y - s * v.x, v.z };",
    "return { c * v.x - s * v.y, c * v.y + s * v.x, v.z };", MODELS)
add("Export.gltf-coat-at-the-half-vector", "PbrModels.cxx", "(1.0 - DielectricF0) * Schlick(d.NdV)",
    "(1.0 - DielectricF0) * Schlick(d.VdH)", MODELS)
add("Export.gltf-sheen-without-scale", "PbrModels.cxx", "f = f * GetSheenScale(v, d) +", "f = f +", MODELS)
add("Export.materialx-without-compensation", "MaterialXModels.cxx",
    "return dvec3(1.0) + fresnel * ((1.0 - single) / single);", "return dvec3(1.0);", MODELS)
add("Export.materialx-layer-lets-all-through", "MaterialXModels.cxx", "return top.Response + base * top.Throughput;",
    "return top.Response + base;", MODELS)
add("Export.openpbr-coat-leaves-the-base-smooth", "MaterialXModels.cxx",
    "return own + (coated - own) * v.Coat;", "return own;", MODELS)
add("Export.openpbr-coat-does-not-darken", "MaterialXModels.cxx", " * glm::clamp(GetDarkening(v), 0.0, 1.0)", "",
    MODELS)
add("Export.preview-surface-clearcoat-index", "PbrModels.cxx",
    "coat * (reflectance + (1.0 - reflectance) * s)", "coat * (0.04 + 0.96 * s)", MODELS)
add("Export.vtk-coat-passed-once", "PbrModels.cxx", "specular * Square(1.0 - coat)", "specular * (1.0 - coat)", MODELS)
add("Export.light-below-the-nodes-is-lost", "LitSphere.cxx", "+= weights[k] / sum *", "+= weights[k] *",
    "ExportLitSphere.KeepsAllLight")
add("Export.lit-sphere-without-cosine", "LitSphere.cxx", "direction.z * solidAngle * rgb", "solidAngle * rgb",
    "ExportLitSphere.KeepsAllLight")
add("Export.every-part-is-worth-it", "ModelFit.cxx",
    "worthIt = best.Error - next.Error >= std::max(WorthIt * best.Error, WorthAtLeast);", "worthIt = true;",
    "ExportFit.TakesNoPartThatIsOfNoUse|ExportFit.FindsWhatIsThere")
add("Export.lights-count-by-brightness", "ModelFit.cxx", "wanted.colwise().mean().max(1e-300);",
    "wanted.colwise().mean().max(1e300).min(1.0);", "ExportFit.EveryLightCountsTheSame")
add("Export.rounded-beyond-the-range", "ExportFiles.cxx",
    "values[at] = rounded <= parameter.Most ? rounded : std::floor(1e4 * values[at]) / 1e4;", "values[at] = rounded;",
    "ExportFiles.NumbersAndNames")
add("Export.gltf-triangles-inside-out", "ExportFiles.cxx", "corner, below, below + 1, corner, below + 1, corner + 1",
    "corner, below + 1, below, corner, corner + 1, below + 1", "ExportFiles.VtkReadsGltf")
add("Export.gltf-extension-not-declared", "ExportFiles.cxx", "    file[\"extensionsUsed\"].push_back(extension);\n", "",
    "ExportFiles.GltfHasTheExtensionsThatAreUsed")

add("Material.map-weights-fall-below-0", "vtkMaterialMap.cxx",
    "return std::max(1.0 - (value - own) / (next - own), 0.0);",
    "return 1.0 - (value - own) / (next - own);", "MaterialMap.ValuesBlendLinearly")
add("Material.map-parameters-divide-anew", "vtkMaterialMap.cxx", "vtkMTimeType time = this->Superclass::GetMTime();",
    "vtkMTimeType time = this->Materials.empty() || !this->Materials[0].BRDF ? this->Superclass::GetMTime() : "
    "this->Materials[0].BRDF->GetMTime();", "MaterialMap.ParametersOfAMaterialDivideNothingAnew")
add("Rendering.map-weights-are-not-divided-by-their-sum", "MaterialPieces.cxx", "static_cast<float>(weight / sum)",
    "static_cast<float>(weight)", "Parts.WeightsAreDividedByTheirSum")
add("Rendering.map-points-of-two-parts-are-not-doubled", "MaterialParts.cxx", "(owner != groups.size() && owner != g)",
    "false", "Parts.ManySetsAreMerged|MaterialMapping.ValuesBlendInEachPixel")
add("Rendering.map-borders-run-off-the-middle", "MaterialPieces.cxx", "const vtkIdType toB = this->FindPoint(b, other, 0, 0.5);",
    "const vtkIdType toB = this->FindPoint(b, other, 0, 0.51);",
    "Parts.BordersBetweenClassesOfPointsAreCut")
add("Rendering.map-edges-are-cut-twice", "MaterialPieces.cxx", "try_emplace({ low, high, which }, 0);\n  if (isNew)",
    "try_emplace({ low, high, which }, 0);\n  if (true)",
    "Parts.BordersBetweenClassesOfPointsAreCut")
add("Rendering.map-lone-corners-lose-their-class", "MaterialPieces.cxx",
    "{ other, toA, toB }, cell, { this->Classes[other] }", "{ other, toA, toB }, cell, { cls }",
    "MaterialMapping.ClassesOfPointsAreThoseOfTheNearest")
add("Rendering.map-hidden-skies-are-bytes", "MaterialPieces.cxx", "HorizonCode::PackNormal(normal, bytes);", "",
    "Cuts.WithHiddenSkiesAreUnseen")
add("Rendering.map-values-fall-beside-their-knots", "MaterialPieces.cxx", "(*knot - from) / (to - from)",
    "0.9 * (*knot - from) / (to - from)", "MaterialMapping.ValuesBlendInEachPixel")
add("Rendering.map-scalars-that-choose-color", "DividedSurface.cxx", "if ((ofMap && all) || ",
    "if (",
    "MaterialMapping.ScalarsThatChooseDoNotColor")
add("Rendering.map-classes-released-elsewhere", "PartsMapper.cxx",
    "this->OwnWindow->PushContext();", "", "ManyClasses.LeaveOtherWindowsAlone")
add("Rendering.map-classes-share-cell-colors", "PartsMapper.cxx",
    "this->PrimitiveIDOffset = this->Shown->FirstPrimitive;", "",
    "ManyClasses.ColorsOfCellsStayTheirOwn")
add("Rendering.map-members-share-instances", "BRDFShader.cxx", "return 100 * member;", "return 0 * member;",
    "MaterialMapping.ValuesBlendInEachPixel")
add("Rendering.map-divided-blocks-are-drawn-whole", "BlockBatch.cxx",
    "if (this->BRDFs.size() < 2 && !this->HasDivided)", "if (this->BRDFs.size() < 2)",
    "MaterialMapping.CompositeDataShowTheSame")
add("Material.angular-table-azimuths-end", "vtkAngularTableBRDF.cxx",
    "const std::size_t right = next % count;", "const std::size_t right = std::min(next, count - 1);",
    "IOUtia.InterpolatesAlongAllFourAxes")
add("IO.utia-blue-first", "UtiaFile.cxx", "rgb[3 * (k % Plane) + k / Plane] = f;", "rgb[3 * (k % Plane) + 2 - k / Plane] = f;",
    "IOUtia.InterpolatesAlongAllFourAxes")
add("Material.angular-table-turned-the-other-way", "vtkAngularTableBRDF.cxx", "i[0] * o[1] - i[1] * o[0])", "i[1] * o[0] - i[0] * o[1])",
    "IOOpenMaterial.AzimuthsRunAboutTheNormal")
add("Material.angular-table-copy-forgets-the-origin", "vtkAngularTableBRDF.cxx", "  copy->Origin = this->Origin;\n", "",
    "IOOpenMaterial.InterpolatesBetweenUnevenAngles")
add("IO.gonio-mirrors-about-the-other-plane", "GonioTable.cxx", "mirrored.PhiO = FullTurn - mirrored.PhiO;",
    "mirrored.PhiO = HalfTurn + mirrored.PhiO;", "IOOpenMaterial.InterpolatesBetweenUnevenAngles")
add("IO.gonio-extrapolates", "GonioTable.cxx", "nodes.Theta.back() < Horizon)", "nodes.Theta.back() < 0.0f)",
    "IOOpenMaterial.HolesAreFilledAndReported")
add("IO.gonio-holes-take-one-neighbor", "GonioTable.cxx", "mix(1, first + k, first + a, first + b, share);",
    "mix(1, first + k, first + a, first + a, share);",
    "IOOpenMaterial.HolesAreFilledAndReported")
add("IO.gonio-scatter-takes-the-nearest", "GonioTable.cxx", "constexpr int Neighbors = 8;", "constexpr int Neighbors = 1;",
    "IOOpenMaterial.ScatteredViewsAreInterpolated")
add("IO.open-material-swaps-directions", "OpenMaterialFile.cxx",
    "{ angles[0], 0.0f, angles[1],", "{ angles[1], 0.0f, angles[1],",
    "IOOpenMaterial.InterpolatesBetweenUnevenAngles")
add("IO.astm-angles-always-in-degrees", "AstmFile.cxx", "angles[k] = degrees ? angle : ToDegrees(angle);", "angles[k] = angle;",
    "IOAstm.InterpolatesOnAGrid")
add("IO.astm-other-side-forgotten", "AstmFile.cxx", "angles[k + 1] += angles[k] < 0.0 ? 180.0 : 0.0;", "",
    "IOAstm.NegativePolarAnglesAreOnTheOtherSide")
add("IO.astm-number-of-points-ignored", "AstmFile.cxx", "rows == 0 || (this->Points > 0.0 &&", "rows == 0 || (false &&",
    "IOAstm.RefusesBadFiles")
add("IO.infrared-counts-as-visible", "SpectralColor.cxx", "wavelength < LastVisible + 0.5;", "wavelength < 2.0 * LastVisible;",
    "IOOpenMaterial.OneWavelengthIsGray")
add("IO.spectra-under-equal-energy", "SpectralColor.cxx", "entry.w * glm::dvec3(entry)",
    "glm::dvec3(entry)", "IOSpectral.AgreesWithAnotherProgramsSum")
add("IO.spectra-not-scaled-to-white", "SpectralColor.cxx", "weight / sums * white", "weight / sums.y * white", "IOSpectral.FlatSpectraAreGray")
add("IO.spectral-takes-the-first-value", "TensorFile.cxx", "toRgb * values.cast<double>()",
    "toRgb.rowwise().sum() * values.row(0).cast<double>()", "IOSpectral.AgreesWithAnotherProgramsSum")
add("Rendering.legend-shows-the-last-first", "vtkMaterialLegendActor.cxx",
    "bottom + height - (place % rows + 0.5)", "bottom + (place % rows + 0.5)",
    "MaterialLegend.DrawsSpheresBelowEachOther")


# Fetch

add("Fetch.http-from-anywhere", "Download.cxx", "(scheme == \"http\" && isThisMachine)", "scheme == \"http\"",
    "Download.OnlyHttpsElsewhere")
add("Fetch.name-and-password", "Download.cxx", "GetPart(url, CURLUPART_USER).empty() && ",
    "", "Download.OnlyHttpsElsewhere")
add("Fetch.files-have-no-names", "FetchCatalog.cxx", "return entry.Name == name || entry.File == name;",
    "return entry.Name == name;", "FetchCatalog.NamesAndFiles")

# What surfaces hide

add("Visibility.hidden-rays-without-cosine", "HorizonCode.cxx", "transfer[j] += d.z * values[j];",
    "transfer[j] += values[j];", "HorizonLight.ACraterHidesTheLowSky")
add("Visibility.sectors-count-backwards", "HorizonCode.cxx", "return SectorWidth * sector;",
    "return -SectorWidth * sector;", "OcclusionTest.LobesLackTheirHiddenShare")
add("Visibility.empty-sectors-at-the-horizon", "HorizonCode.cxx", "interval = { place, place };",
    "interval = { 0.0 * place, 0.0 };", "HorizonLight.FloatingBodiesEndBetweenSectors")
add("Visibility.openings-from-the-horizon", "HorizonCode.cxx", "const bool asks = this->Opening &&", "const bool asks = !this->Opening &&",
    "HorizonLight.SillsOfOpeningsHideTheHorizon")
add("Visibility.narrow-slits-are-open", "HorizonCode.cxx", "intervals.IsOpening() && width == 0", "intervals.IsOpening() && width < 0",
    "HorizonLight.NarrowSlitsAreDark")
add("Visibility.hollows-by-what-they-hide", "HorizonCode.cxx", "this->Opening = misfit[1] < misfit[0];",
    "this->Opening = false;", "HorizonLight.HollowsHideFromBothSides")
add("Visibility.strata-without-offset", "HorizonCode.cxx",
    "return ReverseBits(static_cast<unsigned>(sector)) + 0.5 / Sectors;", "return 0.5;",
    "SurfaceVisibility.BlocksHideOneAnother")
add("Visibility.origins-on-edges", "SurfacePoints.cxx", "constexpr double Inwards = 0.02;",
    "constexpr double Inwards = 0.0;", "SurfaceVisibility.EdgesBelongToTheirOwnSide")
add("Visibility.key-without-cells", "SurfacePoints.cxx", "hash.AddValues(ids);", "",
    "SurfaceVisibility.KeysSeePointsNormalsAndCells")
add("Visibility.key-without-normals", "SurfacePoints.cxx", "HashArray(hash, surface->GetPointData()->GetNormals());", "",
    "OcclusionTest.BadArraysAreSaidOnceAndNotUsed")
add("Visibility.rays-begin-below-twisted-quads", "SurfacePoints.cxx", "ForEachFace(surface, Faces::Triangles,",
    "ForEachFace(surface, Faces::Polygons,", "SurfaceVisibility.TwistedQuadsAreLeftFromTheirTriangles")
add("Rendering.occlusion-whatever-it-costs", "AutomaticOcclusion.cxx", "return worth && !this->Found.IsLeftOut;",
    "return !this->Found.IsLeftOut;", "OcclusionTest.AutoModelsWhatIsWorthIt")
add("Rendering.mappers-trace-apart", "SharedTrace.cxx", "traces.FindOrMake(content,",
    "traces.FindOrMake(content + std::to_string(input->GetMTime()),",
    "SharedTraceTest.MappersOfOneSurfaceTraceOnce|SharedTraceTest.OccludersAreNotShared")
add("Rendering.shared-without-the-bounce", "SharedTrace.h", "(!withBounce || this->HasBounce)", "true",
    "SharedTraceTest.MappersOfOneSurfaceTraceOnce")
add("Rendering.traces-of-others", "AutomaticOcclusion.cxx", "if (stamp == this->Stamp)",
    "if (stamp.size() == this->Stamp.size())", "SharedTraceTest.SurfacesThatSharePointsKeepApart")
add("Rendering.blocks-without-arrays-stay-open", "MaterialDrawingOcclusion.cxx", "this->Given.Blocks == this->Given.All)",
    "this->Given.Blocks > 0)", "OcclusionBlocks.SomeHaveArrays")
add("Rendering.arrays-alone-are-traced", "MaterialDrawingOcclusion.cxx", "const bool always = this->Settings->OcclusionMode == 2;",
    "const bool always = this->Settings->OcclusionMode > 0;",
    "OcclusionBlocks.SomeHaveArrays")
add("Rendering.traced-without-other-data", "MaterialDrawingOcclusion.cxx", "last.Data->ShallowCopy(surface);",
    "last.Data->ShallowCopy(traced);", "BounceTest.AllMappersDrawTheSame")
add("Rendering.blocks-are-listed-for-each", "SurfaceBlocks.cxx", "this->Other != other ||", "this->Other != nullptr ||",
    "OcclusionBlocks.ManyAreListedOnce")
add("Rendering.blocks-are-compared-for-each", "MaterialDrawingOcclusion.cxx", "if (always && !this->IsTraceCurrent)",
    "if (always)", "OcclusionBlocks.ManyAreListedOnce")
add("Rendering.moved-blocks-hide-where-they-were", "MaterialDrawing.cxx", "  this->IsTraceCurrent = false;\n", "",
    "OcclusionBlocks.OneThatMovesShowsOnTheOthers")
add("Rendering.threads-trace-at-once", "SharedTrace.cxx", "while (!lock.try_lock_for(Patience))", "while (false)",
    "SharedTraceTest.ThreadsWaitForOneAnother")
add("Rendering.forecasts-outlive-mappers", "AutomaticOcclusion.cxx", "[this]() { return !this->IsStopped; }",
    "[]() { return true; }", "SharedTraceTest.ForecastsStopWhenTheyGo")
add("Rendering.moving-surfaces-are-traced", "AutomaticOcclusion.cxx", "return this->Changes <= MostChanges;", "return true;",
    "OcclusionTest.ForecastsFollowTheSurface")
add("Rendering.views-forget-each-other", "AutomaticOcclusion.cxx", "!this->Work && !this->Known.Find(key)",
    "!this->Work && (!this->Answer || this->Asked != key)", "OcclusionTest.ForecastsFollowTheSurface")
add("Rendering.views-for-ever", "AutomaticOcclusion.cxx", "MostAnswers = 1024;", "MostAnswers = 4;",
    "Forecast.ViewsThatTakeTurnsComeToAnEnd")
add("Rendering.throws-end-the-thread-unsaid", "AutomaticOcclusion.cxx",
    "this->Found.Most, *problem };", "this->Found.Most, std::string() };", "Forecast.TellsWhatIsThrown")
add("Core.threads-outlive-the-process", "BackgroundThreads.cxx", "      thread.Stop();", "",
    "EndOfProcess.StopsPlans|EndOfProcess.StopsForecasts")
add("Core.objects-outlive-the-process", "BackgroundThreads.cxx", "      (*release)();", "",
    "EndOfProcess.LeavesNoObjects")
add("Rendering.attributes-without-end", "MaterialShading.cxx",
    "own + needs.Attributes <= this->Limits.Attributes &&", "", "LimitsTest.DrawsWhatThereIsRoomFor")
add("Rendering.clipping-takes-no-varyings", "MaterialShading.cxx",
    "this->Mapper->GetNumberOfClippingPlanes() > 0 ? 6 : 0", "0", "LimitsTest.ClippingPlanesAndEdgesTakeVaryings")
add("Rendering.failures-are-said-once", "MaterialDrawing.cxx",
    "this->Failures.count(it->first) == 0;", "this->Failures.count(it->first) == 2;", "LimitsTest.AThrowIsOneErrorAndTheNextRenderWorks")
add("Rendering.what-throws-is-not-drawn", "MaterialShading.cxx", "tries = !this->IsPlain;",
    "tries = false;", "LimitsTest.AThrowIsOneErrorAndTheNextRenderWorks")
add("Rendering.shared-created-light-shines", "RenderPassQueries.cxx", "other->GetLights() == renderer->GetLights() &&",
    "false &&", "MapperShading.LightThatVTKCreated")
add("Rendering.hidden-sky-of-the-wrong-side", "OcclusionShader.cxx",
    "dot(normalVCVSOutput, brdfSkyNormalVSOutput) > 0.0", "dot(normalVCVSOutput, brdfSkyNormalVSOutput) < 2.0",
    "OcclusionTest.NormalsMayPointEitherWay")
add("Rendering.outlines-without-hidden-sky", "OcclusionArrays.cxx", "return -std::sqrt(1.0 - cosine * cosine) - margin;",
    "return 0.6 * cosine / margin;", "OcclusionTest.NormalsMayPointEitherWay")
add("Visibility.same-side-twice", "VisibilityTask.cxx", "return side == 0 ? 1.0 : -1.0;",
    "return 1.0;", "SurfaceVisibility.TheOtherSideHasItsOwnSky")
add("Visibility.traced-again", "vtkSurfaceVisibilityFilter.cxx",
    "const bool isKnown = key == this->Key;", "const bool isKnown = false;", "SurfaceVisibility.WhatIsKnownIsNotTracedAgain")
add("Visibility.bounce-beyond-the-sky", "HorizonCode.cxx", "std::floor(root / RootStep)", "std::ceil(root / RootStep)",
    "BouncedLight.CodesKeepTransfers")
add("Visibility.bounce-of-all-rays", "VisibilityTask.cxx", "met > 0.0 ? hidden / met : 0.0", "hidden",
    "BouncedLight.HollowsGetLighterAndNeverLighterThanTheSky|BouncedLight.BouncesAreThoseOfTracedLight")
add("Visibility.bounce-of-the-other-side", "VisibilityTask.cxx", "== (glm::dot(hit.Normal, direction) > 0.0)",
    "!= (glm::dot(hit.Normal, direction) > 0.0)", "BouncedLight.BouncesAreThoseOfTracedLight")
add("Rendering.bounce-without-albedo", "OcclusionShader.cxx", "light.Bounce->Albedo * turned[j] *", "turned[j] *",
    "BounceTest.ShadersAgreeWithTheCppForms")
add("Shaders.bounce-by-the-root", "vtkBRDFBouncedLight.glsl", "max(a.x * a.x * sum, vec3(0.0))",
    "max(a.x * sum, vec3(0.0))", "BounceTest.ShadersAgreeWithTheCppForms")
add("Rendering.stale-visibility", "OcclusionArrays.cxx", "problem = isPart ? \"\" : CheckKey(surface);",
    "problem = \"\";", "OcclusionTest.BadArraysAreSaidOnceAndNotUsed")
add("Rendering.hidden-light-unturned", "OcclusionShader.cxx",
    "GetWorldToEnvironment(renderer, environment) * turned);",
    "GetWorldToEnvironment(renderer, environment));", "OcclusionTest.ActorsMayBeTurnedMirroredAndScaled")
add("Rendering.lobes-see-what-openings-show", "OcclusionShader.cxx", "brdfSkyOpening ? 1.0 - brdfShareOf#M : brdfShareOf#M",
    "brdfShareOf#M", "OcclusionTest.LobesLackTheirHiddenShare")
add("Rendering.lamps-in-tables-shine-through", "OcclusionShader.cxx", "clamp(0.5 - #MARGIN, 0.0, 1.0) * light;",
    "0.0 * light;", "OcclusionTest.LampsBesideTheAxisTakeTheirPartOfTheLobe")
add("Rendering.lobes-without-cosine", "OcclusionLight.cxx", "cell.Cosine * std::exp(", "cell.SolidAngle * std::exp(",
    "OcclusionTest.LobesHaveTheKernelsMean")
add("Shaders.openings-have-roofs-for-walls", "vtkBRDFHiddenSky.glsl", "return opening ? (inside", "return false ? (inside",
    "OcclusionTest.PanelsAreHiddenOneByOne")
add("Rendering.panels-hidden-by-slivers", "OcclusionShader.cxx", "clamp(brdfSkyHidden / max(brdfInSectors#M, 1e-6), 0.0, 1.0)", "1.0",
    "OcclusionTest.PanelsAreHiddenOneByOne")
add("Shaders.planes-by-sines", "vtkBRDFHiddenSky.glsl",
    """65025.0 - 0.96 * bounds * bounds);
}

vec2 brdfSkySines(vec2 tangents)
{
  return tangents * inversesqrt(1.0 + 0.96 *""",
    """65025.0 - 0.0 * bounds * bounds);
}

vec2 brdfSkySines(vec2 tangents)
{
  return tangents * inversesqrt(1.0 + 0.0 *""", "OcclusionTest.PanelsAreHiddenOneByOne")
add("Shaders.lobes-beyond-the-horizon", "vtkBRDFHiddenSky.glsl", "vec3(1.0, 3.0, 5.0) / 12.0 * exp2", "exp2",
    "OcclusionTest.LobesLackTheirHiddenShare")
add("Shaders.lobes-see-whole-panels", "vtkBRDFHiddenSky.glsl",
    "max(z + rise - extent, 0.0);\n  return vec2(low, max(min(z + rise + extent",
    "max(z - extent, 0.0);\n  return vec2(low, max(min(z + extent", "OcclusionTest.PanelsAreHiddenOneByOne")
add("Shaders.lamps-edges-on-points", "vtkBRDFHiddenSky.glsl", "clamp(max(below, above), -3.0, 3.0)", "clamp(max(below, above), -0.5, 0.5)",
    "OcclusionTest.ShadowEdgesCrossTriangles")
add("Shaders.lamps-in-tables-go-with-the-rest", "vtkBRDFHiddenSky.glsl", "  return 1.0 - root * root;", "  return 0.0;",
    "OcclusionTest.LampsBesideTheAxisTakeTheirPartOfTheLobe")
add("Shaders.hidden-sky-odds", "vtkBRDFHiddenSky.glsl", "(12.0 / (12.0 + kappa))",
    "(3.0 / (3.0 + kappa))", "OcclusionTest.LobesLackTheirHiddenShare")
add("Shaders.hidden-irradiance-counts", "vtkBRDFEnvironmentTable.glsl", "sum += BRDF_OPEN_IRRADIANCE(",
    "sum += (", "OcclusionTest.MatteSurfacesLackTheHiddenIrradiance")

add("Rendering.map-ends-of-a-scale-are-mixed", "MaterialPieces.cxx", "std::max<std::size_t>(band, 1) - 1", "band",
    "MaterialMapping.ManyMaterialsOfAScaleInOneTriangle|MaterialMapping.ValuesBlendInEachPixel")
add("Rendering.map-values-end-at-points", "MaterialPieces.cxx", "std::clamp((value - low) / span, -FarOff, FarOff)", "std::clamp((value - low) / span, 0.0, 1.0)",
    "MaterialMapping.ManyMaterialsOfAScaleInOneTriangle")
add("Rendering.map-scalars-color-beside-no-material", "PartsMapper.cxx",
    "return this->AreColorsOfMap &&", "return false &&", "MaterialMapping.ScalarsThatChooseDoNotColor")
add("Rendering.map-scalars-hide-blocks-colors", "DividedSurface.cxx", "|| overrides)", ")",
    "MaterialMapBlocks.ABlocksColorGoesBeforeScalars")
add("Rendering.map-second-weight-array-colors", "MaterialPieces.cxx",
    "reads = reads || MapArray::FindWeights(input, map, k)",
    "reads = reads || MapArray::FindWeights(input, map, 0)", "MaterialMapping.NoneOfSeveralWeightArraysColors")
add("Rendering.map-images-are-looked-at-by-the-first", "WeightImages.cxx", "width = std::max(width, size[0]);",
    "width = width > 0 ? width : size[0];", "Parts.ImagesMayDifferInSize")
add("Rendering.map-images-of-zeros-are-odd", "WeightImages.cxx", "if (anyLeft)",
    "if (components > map->GetNumberOfMaterials())", "MaterialMapping.WeightsOfNoMaterialAreSaidUnlessTheyAreZero")
add("Rendering.map-waits-for-materials-that-left", "MapperPlans.cxx", "inUse.count(member) == 0", "false",
    "MaterialMapping.PlansOfMaterialsThatLeaveAreGivenUp")
add("Rendering.map-time-is-not-taken", "vtkMeasuredBRDFMapper.cxx", "this->TimeToDraw = this->Impl->Parts.GetTimeToDraw();", "",
    "MaterialMapping.TimeOfAllPartsIsTaken")
add("Rendering.map-nothing-is-highlighted", "DividedSurface.cxx", "this->Highlight->SetSelection(selection);", "",
    "MaterialMapping.SelectedCellsAreHighlighted")
add("Rendering.map-images-repeat-for-ever", "ShaderTextures.cxx",
    "    hash.AddValue(static_cast<bool>(texture.Repeat[static_cast<std::size_t>(axis)]));\n",
    "", "MaterialMapping.OnlyChangedImagesAreUploaded")
add("Integration.tails-of-one-side", "vtkHybridRadianceIntegrator.cxx", "for (const double turn : { azimuth, -azimuth })",
    "for (const double turn : { azimuth, azimuth })", "TailRegularity.OfOddTables")
add("Visibility.occluders-stay", "vtkSurfaceVisibilityFilter.cxx", "occluder.Matrix ? occluder.Matrix->GetMTime() : 0", "0",
    "OcclusionStability.OccludersMayMove")
add("Visibility.bounce-of-an-earlier-run-stays", "vtkSurfaceVisibilityFilter.cxx",
    "    data->RemoveArray(name.c_str());", "", "BouncedLight.OfAnEarlierRunGoes")
add("Visibility.buried-points-darken", "VisibilityTask.cxx", "constexpr double buried = 0.99;",
    "constexpr double buried = 2.0;", "OcclusionStability.PointsInsideOtherBodiesDarkenNothing")
