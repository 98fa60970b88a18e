#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests of the plugin in a build folder:
#
#   Hosts/ParaView/Testing/run.sh BUILD [TEST...]
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: Hosts/ParaView/Testing/run.sh BUILD [TEST...]" >&2; exit 2; }
build=$(cd "$1" && pwd)
shift
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
MEASUREDBRDF_PARAVIEW_PLUGIN=$(find "$build" -name MeasuredMaterials.so | head -n 1)
[ -n "$MEASUREDBRDF_PARAVIEW_PLUGIN" ] || { echo "run.sh: no MeasuredMaterials.so below $build" >&2; exit 2; }
MEASUREDBRDF_PARAVIEW_OUTPUT=$root/output/paraview
MEASUREDBRDF_PARAVIEW_FIT=$root/Module/IO/Data/EmbeddedFits.fit
export MEASUREDBRDF_PARAVIEW_FIT MEASUREDBRDF_PARAVIEW_PLUGIN MEASUREDBRDF_PARAVIEW_OUTPUT PYTHONDONTWRITEBYTECODE=1
mkdir -p "$MEASUREDBRDF_PARAVIEW_OUTPUT"
[ -n "${DISPLAY:-}" ] || exec xvfb-run -a -s "-screen 0 1440x1280x24 -noreset" "$PWD/run.sh" "$build" "$@"

# The first rank works in a folder of its own, which has the files. Each rank has its log: ranks-COUNT-rank-RANK.log.
ranks() {
  local status=0
  mkdir -p "$MEASUREDBRDF_PARAVIEW_OUTPUT/first-rank" "$MEASUREDBRDF_PARAVIEW_OUTPUT/other-ranks"
  mpiexec -n "$1" bash -c '
    rank=${OMPI_COMM_WORLD_RANK:-${PMIX_RANK:-${PMI_RANK:?}}}
    [ "$rank" -eq 0 ] && folder=first-rank || folder=other-ranks
    cd "$MEASUREDBRDF_PARAVIEW_OUTPUT/$folder" && log=$MEASUREDBRDF_PARAVIEW_OUTPUT/ranks-$1-rank-$rank.log
    exec pvbatch "${@:2}" >"$log" 2>&1' rank "$1" "$PWD/$2" "${@:3}" || status=$?
  for rank in $(seq 0 $(($1 - 1))); do
    sed "s/^/rank $rank: /" "$MEASUREDBRDF_PARAVIEW_OUTPUT/ranks-$1-rank-$rank.log"
  done
  return "$status"
}
run_representation() { pvpython test_representation.py; }
run_data() {
  pvpython test_data.py
  mpiexec -n 2 pvbatch "$PWD/test_data.py"
}
run_sources() { pvpython test_sources.py; }
run_parallel() {
  for count in 1 2 4; do
    ranks "$count" test_parallel.py "$count"
  done
  pvpython test_parallel.py compare
}
# with_server TEST [OPTION...]: the test as the client of a server on two ranks with these options
with_server() {
  port=$((20000 + RANDOM % 20000))
  mpiexec -n 2 pvserver --server-port="$port" "${@:2}" >"$MEASUREDBRDF_PARAVIEW_OUTPUT/pvserver-$1.log" 2>&1 &
  server=$!
  pvpython "test_$1.py" "$port" || { kill "$server" 2>/dev/null; return 1; }
  wait "$server"
}
run_server() { with_server server; }
# Each rank's tile is a window on the one display, with borders instead of filling the screen.
run_tiles() { PV_ICET_WINDOW_BORDERS=1 with_server tiles --tdx=2 --tdy=1; }

# One scene by two hosts, and on two ranks. In ParaView's window the script runs first, then the test player looks at the window.
run_same_scene() {
  version=$(pvpython -c 'from paraview.simple import *; v = GetParaViewVersion(); print(f"{v.major}.{v.minor}")' | tail -n 1)
  prefix=same-scene-paraview-$version
  export PYTHONPATH=$PWD:$PWD/../../../Testing/SameScene # a script of the window has no __file__
  MEASUREDBRDF_PARAVIEW_PICTURE=$prefix-pvbatch pvbatch "$PWD/same_scene.py"
  for count in 1 2; do
    MEASUREDBRDF_PARAVIEW_PICTURE=$prefix-off-$count mpiexec -n "$count" pvbatch "$PWD/same_scene.py" Off
  done
  settings=$(mktemp -d)
  MEASUREDBRDF_PARAVIEW_PICTURE=$prefix-window PV_PLUGIN_PATH=${MEASUREDBRDF_PARAVIEW_PLUGIN%/*} HOME=$settings \
    QT_QPA_PLATFORM=xcb timeout 200 paraview --plugins=MeasuredMaterials --disable-registry --script="$PWD/same_scene.py" \
    --test-directory="$settings" --test-script="$PWD/same_scene.xml" --exit
  pvpython test_same_scene.py "$prefix"
}

cpu_ticks() { awk '{ print $14 + $15 }' "/proc/$1/stat"; }
# ParaView's window with balls, driven by its own test player. One that fails closes with an error; else it stays for the
# picture window.png.
run_gui() {
  out=$MEASUREDBRDF_PARAVIEW_OUTPUT
  PYTHONPATH=$PWD/../../../Testing/SameScene pvpython -c 'import os, scene_files; scene_files.write_scene(os.environ["MEASUREDBRDF_PARAVIEW_OUTPUT"] + "/gui")'
  settings=$(mktemp -d)
  export PV_PLUGIN_PATH=${MEASUREDBRDF_PARAVIEW_PLUGIN%/*} QT_QPA_PLATFORM=xcb
  HOME=$settings paraview --plugins=MeasuredMaterials --disable-registry --test-directory="$settings" "$out/gui/balls.vtp" \
    --test-script="$PWD/gui.xml" >"$out/window-messages.log" 2>&1 &
  window=$!
  for _ in $(seq 60); do
    sleep 1
    xdotool search --onlyvisible --name ParaView windowmove 0 0 windowsize 1400 1250 2>/dev/null && break
  done
  # Until the program rests: it plans and draws before it answers, so a still window tells nothing.
  for _ in $(seq 40); do
    used=$(cpu_ticks "$window")
    sleep 5
    [ $(($(cpu_ticks "$window") - used)) -gt 25 ] || break
  done
  import -window root "$out/window.png"
  kill "$window"
  wait "$window" || true
  convert "$out/window.png" -crop 1400x1250+0+0 +repage "$out/window.png"
  ! grep -A 6 '^critical:' "$out/window-messages.log" # what the player says of an event or a check that failed
}

tests=("$@")
[ $# -gt 0 ] || tests=(representation data sources parallel server tiles same_scene gui)
failed=()
for test in "${tests[@]}"; do
  declare -F "run_$test" >/dev/null || { echo "run.sh: no test $test" >&2; exit 2; }
  log=$MEASUREDBRDF_PARAVIEW_OUTPUT/$test.log
  printf '%-16s' "$test"
  # One that hangs is a failure, too.
  export -f "run_$test" ranks with_server cpu_ticks
  if timeout -k 10 600 bash -euo pipefail -c "run_$test" >"$log" 2>&1; then
    echo "passed"
  else
    echo "FAILED; log: $log"
    tail -n 30 "$log"
    failed+=("$test")
  fi
done
echo "$((${#tests[@]} - ${#failed[@]})) passed, ${#failed[@]} failed; pictures: $MEASUREDBRDF_PARAVIEW_OUTPUT"
[ ${#failed[@]} -eq 0 ]
