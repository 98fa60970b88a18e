set -e
cmake/install-packages.sh --tests >/dev/null 2>&1
cmake --preset dev -DPython3_EXECUTABLE=/usr/bin/python3 >/dev/null
cmake --build build -j2 --target RenderMaterialMap RenderScene TestRenderingInternals TestIO TestMaterial 2>&1 | grep -E "error|warning:|FAILED" | head -20 || true
export LIBGL_ALWAYS_SOFTWARE=1 MEASUREDBRDF_CACHE=off
for t in RenderMaterialMap RenderScene; do xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" build/bin/$t 2>&1 | grep -v "RUN\|   OK" | tail -25; done
build/bin/TestRenderingInternals --gtest_filter='Parts*' | tail -3
build/bin/TestIO --gtest_filter='*Utia*' 2>&1 | tail -3
build/bin/TestMaterial 2>&1 | tail -3
