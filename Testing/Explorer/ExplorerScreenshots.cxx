// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Makes the pictures of docs/explorer.md: ExplorerScreenshots FOLDER [HEIGHT [FILE.xml]],
// or saves the picture of a state: ExplorerScreenshots STATE.json SIZE PICTURE.png
#include "Window.h"

#include <QtTest>

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace explorer;

namespace
{
constexpr int Patience = 600000; // ms

//------------------------------------------------------------------------------
void Settle(Window& window)
{
  QTest::qWait(500);
  if (!QTest::qWaitFor([&window]() { return window.IsSettled(); }, Patience))
  {
    std::printf("not settled after %d s; the next picture shows what is there\n", Patience / 1000);
  }
  QTest::qWait(500);
}

//------------------------------------------------------------------------------
void Shoot(Window& window, const QString& folder, const char* name)
{
  QTest::qWait(500);
  const QString path = folder + "/explorer-" + name + ".png";
  const QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
  const bool isSaved = image.save(path, "PNG");
  std::printf("%s%s\n", qPrintable(path), isSaved ? "" : ": could not be written");
}
}

//------------------------------------------------------------------------------
// A BSDF file that holds transmission: no material that is built in does. No exact picture is
// beside it: the lobes are what is shown, and such a file's takes minutes.
static void ShootTransmission(Window& window, const QString& folder, const QString& file)
{
  Session* session = window.GetSession();
  session->SetMaterial(file.toStdString());
  session->SetMethod(1, method::PBR);
  session->SetLobe(40.0, 200.0);
  window.ShowTab("Lobe");
  Settle(window);
  Shoot(window, folder, "transmission");
  session->Set(&State::SlicePolar, true, &Session::slicesChanged);
  window.ShowTab("Slices");
  Settle(window);
  Shoot(window, folder, "transmission-polar");
  session->Set(&State::SlicePolar, false, &Session::slicesChanged);
  Shoot(window, folder, "transmission-slices");
  window.ShowTab("Material");
  Shoot(window, folder, "transmission-findings");
}

//------------------------------------------------------------------------------
// The picture as a user saves it, SIZE pixels wide and high.
int SaveStatePicture(const char* file, int size, const QString& picture)
{
  Window window(LoadState(file));
  window.GetView()->setFixedSize(size, size);
  window.show();
  Settle(window);
  return window.SavePicture(picture) ? 0 : 1;
}

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::puts("usage: ExplorerScreenshots FOLDER [HEIGHT of exact pictures [FILE.xml: only its "
              "transmission]]\n       ExplorerScreenshots STATE.json SIZE PICTURE.png");
    return 2;
  }
  const QString folder = argv[1];
  const Application application(argc, argv);
  if (folder.endsWith(".json") && argc == 4)
  {
    return SaveStatePicture(argv[1], std::atoi(argv[2]), argv[3]);
  }
  State state;
  state.Material = "gold-paint";
  state.Environment = "hall";
  state.Mesh = "ball-on-foot";
  state.Methods = { method::Planned, method::Reference };
  state.ReferenceHeight = argc > 2 ? std::atoi(argv[2]) : 512;
  Window window(state);
  window.resize(1280, 800);
  window.show();
  Settle(window);
  if (argc > 3)
  {
    ShootTransmission(window, folder, argv[3]);
    return 0;
  }
  Shoot(window, folder, "window");
  window.GetSession()->SetMethod(1, method::LightSet);
  Settle(window);
  window.ShowTab("Light");
  Shoot(window, folder, "lights");
  window.GetSession()->SetShown(Shown::Difference);
  window.ShowTab("Material");
  Settle(window);
  Shoot(window, folder, "difference");
  window.GetSession()->SetShown(Shown::Split);
  window.GetSession()->SetMethod(1, method::PBR);
  window.ShowTab("Lobe");
  Settle(window);
  Shoot(window, folder, "lobe");
  window.ShowTab("Slices");
  Shoot(window, folder, "slices");
  window.GetSession()->SetCompared({ "nickel", "yellow-matte-plastic", "blue-car-paint" });
  window.GetSession()->Set(&State::SlicePolar, true, &Session::slicesChanged);
  Settle(window);
  Shoot(window, folder, "polar");
  window.GetSession()->Set(&State::SlicePolar, false, &Session::slicesChanged);
  window.GetSession()->SetCompared({});
  window.ShowTab("Image");
  Shoot(window, folder, "image");
  // The directional light with a model.
  Session* session = window.GetSession();
  session->SetEnvironment(DirectionalLightName);
  session->SetMethod(1, method::Reference);
  session->SetMaterial("model:Distribution albedo=0.06,0.03,0.02 f0=0.9,0.6,0.35 exponent=60");
  window.ShowTab("Model");
  Settle(window);
  Shoot(window, folder, "model");
  return 0;
}
