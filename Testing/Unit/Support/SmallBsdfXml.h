// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A BSDF XML file of five patches: one to 30 degrees, four beyond.
 */

#ifndef SmallBsdfXml_h
#define SmallBsdfXml_h

#include "NumberText.h"

#include <string>

/// What the reader calls the format.
const std::string BsdfXmlFormat = "BSDF XML";

inline std::string MakeBsdfXmlBlock(
  const std::string& wavelength, const std::string& direction, double first, double step = 0.01)
{
  std::string text =
    "<WavelengthData><LayerNumber>System</LayerNumber><Wavelength unit=\"Integral\">" + wavelength +
    "</Wavelength><WavelengthDataBlock><WavelengthDataDirection>" + direction +
    "</WavelengthDataDirection><ColumnAngleBasis>Five</ColumnAngleBasis>"
    "<RowAngleBasis>Five</RowAngleBasis><ScatteringDataType>BTDF</ScatteringDataType>"
    "<ScatteringData>\n";
  for (int k = 0; k < 25; ++k)
  {
    text += measuredbrdf::FixedText(first + step * k, 6) + (k % 5 == 4 ? ",\n" : ", ");
  }
  return text + "</ScatteringData></WavelengthDataBlock></WavelengthData>\n";
}

/// The value k of visible reflection is 0.1 + 0.01 k at the side that the file calls back, and 0.5
/// + 0.01 k at the other.
inline std::string MakeBsdfXml(
  const std::string& structure = "Columns", const std::string& more = std::string())
{
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- made by a test -->\n"
         "<WindowElement xmlns=\"http://windows.lbl.gov\"><Optical><Layer><Material>"
         "<Name>Grate &amp; shade</Name></Material><DataDefinition><IncidentDataStructure>" +
         structure +
         "</IncidentDataStructure><AngleBasis><AngleBasisName>Five</AngleBasisName>"
         "<AngleBasisBlock><Theta>0</Theta><nPhis>1</nPhis><ThetaBounds><LowerTheta>0</LowerTheta>"
         "<UpperTheta>30</UpperTheta></ThetaBounds></AngleBasisBlock>\n"
         "<AngleBasisBlock><Theta>60</Theta><nPhis>4</nPhis><ThetaBounds><LowerTheta>30</"
         "LowerTheta>"
         "<UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock></AngleBasis></"
         "DataDefinition>\n" +
         MakeBsdfXmlBlock("Solar", "Reflection Back", 9.0) +
         MakeBsdfXmlBlock("Visible", "Transmission Back", 7.0) +
         MakeBsdfXmlBlock("Visible", "Reflection Front", 0.5) +
         MakeBsdfXmlBlock("Visible", "Reflection Back", 0.1) + more +
         "</Layer></Optical></WindowElement>\n";
}

inline std::string MakeBsdfXmlTreeBlock(const std::string& direction, const std::string& tree)
{
  return "<WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock>"
         "<WavelengthDataDirection>" +
         direction +
         "</WavelengthDataDirection><AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>" +
         tree + "</ScatteringData></WavelengthDataBlock></WavelengthData>";
}

/// A tensor tree of three or four dimensions.
inline std::string MakeBsdfXmlTree(
  int dimensions, const std::string& tree, const std::string& more = std::string())
{
  return "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree" +
         std::to_string(dimensions) + "</IncidentDataStructure></DataDefinition>" +
         MakeBsdfXmlTreeBlock("Reflection Back", tree) + more +
         "</Layer></Optical></WindowElement>\n";
}

#endif
