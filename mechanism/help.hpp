// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of `mechanism --help` and of the help of each command.
#pragma once

namespace tisserand::mechanism::help {

inline constexpr const char* about =
    R"help(mechanism: dynamics, statics, kinematics and vibrations of flexible mechanisms from superelement files.

  superelement.h5 + scene.yaml -> model -> steps -> results.h5 -> pictures and tables

Examples:
  mechanism check arm.scene.yaml                       checks the scene, counts degrees of freedom
  mechanism run arm.scene.yaml -o arm.results.h5       computes the motion
  mechanism run arm.scene.yaml --set integrator.step=0.005 --set bodies.arm.modes=2
  mechanism channels arm.results.h5                    lists the stored channels with their units
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z -o arm.png
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference fine.results.h5 -o arm.pdf
  mechanism view arm.results.h5 -o arm.html            a page that shows the motion in any browser
  mechanism picture arm.results.h5 --time 1.2 -o a.png a picture at t = 1.2
  mechanism study arm.study.yaml --tolerance 1e-3      finds the cheapest setting for this error
  mechanism ledger arm.scene.yaml                      what each effect changes and costs
  mechanism export arm.results.h5 -c energy -o arm.csv

A scene in ten lines:
  scene: pendulum
  gravity: [0, 0, -9.81]
  bodies:
    arm: {type: superelement, file: arm.superelement.h5, modes: 4}
  joints:
    hinge: {type: revolute, a: ground, b: arm/base, axis: [0, 1, 0]}
  loads:
    push: {type: force, at: arm/tip, value: [0, "10 * sin(2 * t)", 0]}
  integrator: {step: 0.01, end: 5}
  output: {every: 10}

Units are those of the scene, by default m, kg, s. Angles are in radians.
Without -o, an output file is written next to its input file.
Exit codes: 0 done, 1 error, 2 wrong usage, 3 did not converge, 130 interrupted.)help";

inline constexpr const char* about_run = R"help(Simulates a scene and writes its results.

  mechanism run arm.scene.yaml
  mechanism run arm.scene.yaml -o fine.results.h5 --set integrator.step=0.001
  mechanism run arm.scene.yaml --set 'loads.push.value=[0, 0, "5 * t"]' --set output.channels='[nodes/position, energy]'

If a scene has several `analyses`, all run in order. Each one writes <scene>.<analysis>.results.h5. --analysis runs only
one of them and, before it, the analyses from which it starts.

  mechanism run arm.scene.yaml --analysis tones
  mechanism run arm.scene.yaml --set checkpoint.every=1000
  mechanism run arm.scene.yaml --restart arm.checkpoint.h5 --append
  mechanism run arm.scene.yaml --restart arm.checkpoint.h5 -o rest.results.h5

--restart continues a run. From a checkpoint, the results are equal bit for bit to those of an uninterrupted run on the
same machine with the same program. From an instant of a results file, they are accurate to the tolerance.
With --append, one file holds the rows of both runs, and the instant where they join only once. The old results are
replaced when the new file is complete. Without --append, they are never overwritten.
If values of the scene (a mass, gravity) have changed since, they are listed, and the run stops unless --changed is
given. End time, steps, tolerances and outputs may change without it.

During the run, the rows are written to <output>.part, which can be read at any time. If Ctrl-C, a step that does not
converge or a full disk ends the run, the file keeps the rows so far and the reason. `channels`, `export` and `plot`
read it. File names in the scene and in --set are relative to the folder of the scene, <output> to the current folder.
Exit codes: 0 done, 1 error, 2 wrong usage, 3 did not converge, 130 interrupted.)help";

inline constexpr const char* about_check =
    R"help(Checks a scene without running it: reads all files, counts coordinates, constraints and degrees of freedom.

  mechanism check arm.scene.yaml
  mechanism check arm.scene.yaml --set bodies.arm.modes=2

Exit codes: 0 no errors found, 1 errors, 2 wrong usage.)help";

inline constexpr const char* about_export =
    R"help(Writes channels of a results file as CSV: time, one column per channel, with units; or one row per mode.

  mechanism export arm.results.h5 -o arm.csv
  mechanism export arm.results.h5 -c nodes/position -c 'joints/*/hinge/*' -o arm.csv
  mechanism export arm.results.h5 -c energy -o - | head
  mechanism export tones.results.h5 -c modes/frequency -c modes/damping_ratio -o tones.csv)help";

inline constexpr const char* about_channels = R"help(Lists the channels of a results file with their units.

  mechanism channels arm.results.h5
  mechanism channels arm.results.h5 -c 'nodes/position/arm/*')help";

inline constexpr const char* about_plot =
    R"help(Plots channels of results files with gnuplot, one panel per unit. Modes are drawn as bars.

  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z -o tip.png
  mechanism plot coarse.results.h5 fine.results.h5 --label coarse --label fine -c energy/total -o energy.svg --range 0 2
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference 'measured.csv:t:z:measured' -o tip.png
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference fine.results.h5 -o tip.pdf
  mechanism plot arm.results.h5 -c joints/coordinate -c forces --units deg,kN --size 160x100mm --font 9 -o drive.pdf
  mechanism plot tones.results.h5 -c modes/frequency -c modes/damping_ratio -o tones.png

A reference is drawn as a wide grey line behind the curves. For a reference run, a further panel shows the difference
of each channel with its largest value and RMS. For a CSV reference, --difference adds this panel. If the instants
differ, the history with more instants is interpolated by cubics.

--units takes one unit for each drawn quantity: mm, deg, MPa, kN, N mm, km/h, rpm, ms, %, or with its name: length=mm.
--range and --y-range are in these units. If --size of a .png is in mm, cm or in, the picture has 300 pixels per inch.
All lines are solid. Marks at different places distinguish the curves in print.)help";

inline constexpr const char* about_view =
    R"help(Writes an HTML page that shows a run: moving bodies, curves, report. Any browser opens it without a network.

  mechanism view arm.results.h5 -o arm.html
  mechanism view coarse.results.h5 fine.results.h5 -o both.html
  mechanism view long.results.h5 -o long.html --instants 500 -c energy -c 'nodes/position/arm/*'
  mechanism view crank.results.h5                 writes crank.html
  mechanism view crank.results.h5 --stress        also colours bodies with recovery files by von Mises stress
  mechanism view arm.results.h5 --paraview out    writes files for ParaView into the folder out

Shapes come from `shape` of a body, from the section of a beam, or from the recovery file next to a superelement file.
Other bodies are shown by nodes and straight lines. Format of the page: formats/PAGE.md.)help";

inline constexpr const char* about_picture =
    R"help(Draws states of a run as a PNG picture. It needs Chromium (Debian package chromium) and opens no window.

  mechanism picture arm.results.h5 --time 1.2 -o a.png
  mechanism picture arm.results.h5 --time 0 --time 0.5 --time 1 --size 1200 360 -o states.png
  mechanism picture arm.results.h5 --view -50,20 --exaggerate 20 --colour deformation --trace arm/tip -o a.png
  mechanism picture tones.results.h5 --mode 2 --phase 0 --phase 180 --show nodes --hide grid -o tone.png

The picture shows the same as the page of `mechanism view`. Without --time, it shows the last instant. If all bodies
travel, the camera follows the heaviest one; --follow chooses another body or none. If no body is in view, this is an
error.

Chromium's sandbox protects your files from the page. It does not work for root: then --no-sandbox is required.)help";

inline constexpr const char* about_compare =
    R"help(Compares channels with a reference history: largest and root-mean-square deviation.

  mechanism compare arm.results.h5 -c nodes/position/arm/tip/z --reference reference.csv:t:z --from 1 --to 5
  mechanism compare arm.results.h5 -c nodes/position/rod/end/z --reference other.csv:1:3
  mechanism compare coarse.results.h5 -c nodes/position --reference fine.results.h5

Columns of a CSV file are given by name, or by number from 1. A reference run is compared channel by channel.)help";

inline constexpr const char* about_study =
    R"help(Runs a scene with all combinations of settings and shows error against CPU time.

  mechanism study arm.study.yaml                   writes table.csv, table.json and index.html to the folder arm.study
  mechanism study arm.study.yaml --tolerance 1e-3  prints the cheapest setting with such an error; writes its scene
  mechanism study arm.study.yaml --slurm           runs a job array of Slurm and collects the results at its end

The study file (formats/STUDY.md) names scenes, axes, quantities and the reference. A failed run is part of the results.
After an interruption, the same command continues. Completed runs are not repeated.
Exit codes: 0 done, 1 error, 2 wrong usage, 130 interrupted.)help";

inline constexpr const char* about_ledger =
    R"help(Measures how much each effect of a scene changes the motion, and what it costs.

  mechanism ledger arm.scene.yaml
  mechanism ledger arm.scene.yaml -c nodes/position/arm/tip/z --effect stiffening --effect inertia
  mechanism ledger arm.scene.yaml --windows 1 --share 1       repeats the whole run for each effect
  mechanism ledger arm.scene.yaml --results arm.results.h5 --json

The scene runs once. Then each effect of each body (formats/SCENE.md, effects) and each inertia option of superelements
is switched alone. Some windows of the run are repeated from the same states and compared. For flexibility, stiffening
and inertia, the whole run is repeated from its start.
Changes of positions are relative to the largest displacement in the scene, those of deflections to the largest one
of their body, those of joint forces to the largest joint force. Times are CPU times, the smallest of some repetitions.
Activity is the share of the power that flows through the effect. Nothing is stored.
Exit codes: 0 done, 1 error, 2 wrong usage, 130 interrupted.)help";

}  // namespace tisserand::mechanism::help
