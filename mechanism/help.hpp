// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of `mechanism --help` and of the help of each command.
#pragma once

namespace tisserand::mechanism::help {

inline constexpr const char* about =
    R"help(mechanism: dynamics, statics, kinematics and vibrations of flexible mechanisms from superelement files.

  superelement.h5 + scene.yaml -> model -> steps -> results.h5 -> pictures and tables

Examples:
  mechanism check arm.scene.yaml                       what is wrong, and the mobility
  mechanism run arm.scene.yaml -o arm.results.h5       simulates
  mechanism run arm.scene.yaml --set integrator.step=0.005 --set bodies.arm.modes=2
  mechanism channels arm.results.h5                    what the file holds, with units
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z -o arm.png
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference fine.results.h5 -o arm.pdf
  mechanism view arm.results.h5 -o arm.html            a page with the motion, for any browser
  mechanism picture arm.results.h5 --time 1.2 -o a.png a still of it
  mechanism study arm.study.yaml --tolerance 1e-3      what accuracy costs, and the cheapest setting for it
  mechanism ledger arm.scene.yaml                      what each effect changes, and what it costs
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

Units are those that the scene names, by default m, kg, s; angles in radians.
Without -o an output lies beside the file that it is made of.
Exit codes: 0 done, 1 error, 2 wrong usage, 3 did not converge, 130 interrupted.)help";

inline constexpr const char* about_run = R"help(Simulates a scene and writes its results.

  mechanism run arm.scene.yaml
  mechanism run arm.scene.yaml -o fine.results.h5 --set integrator.step=0.001
  mechanism run arm.scene.yaml --set 'loads.push.value=[0, 0, "5 * t"]' --set output.channels='[nodes/position, energy]'

A scene with several `analyses` runs them all in order, each into <scene>.<analysis>.results.h5; --analysis runs one of them,
and before it those that it starts from.

  mechanism run arm.scene.yaml --analysis tones
  mechanism run arm.scene.yaml --set checkpoint.every=1000
  mechanism run arm.scene.yaml --restart arm.checkpoint.h5 --append
  mechanism run arm.scene.yaml --restart arm.checkpoint.h5 -o rest.results.h5

A run that goes on from a checkpoint is bit-equal to one that was never interrupted (same machine and program); from an
instant of a results file it is accurate to the tolerance. With --append one file holds the rows of both, the joining
instant once; the results that are gone on from stay as they are until the new ones, whole, take their place. Without it
they are never overwritten. Values of the scene that have changed since (a mass, gravity) are listed, and refused without
--changed; the end, steps, tolerances and outputs may change.

While it runs the results grow in <output>.part, readable at any time. Ctrl-C, a step that does not converge and a full disk
close the file with what was reached and the reason; `channels`, `export` and `plot` accept it. Names of files in the scene
and in --set count from the folder of the scene; <output> counts from this folder.
Exit codes: 0 done, 1 error, 2 wrong usage, 3 did not converge, 130 interrupted.)help";

inline constexpr const char* about_check =
    R"help(Reads everything, counts coordinates, constraints and mobility, says what is wrong, runs nothing.

  mechanism check arm.scene.yaml
  mechanism check arm.scene.yaml --set bodies.arm.modes=2

Exit codes: 0 no errors found, 1 errors, 2 wrong usage.)help";

inline constexpr const char* about_export =
    R"help(Writes channels of a results file as CSV: time, then one column per channel, with units; of modes one row per mode.

  mechanism export arm.results.h5 -o arm.csv
  mechanism export arm.results.h5 -c nodes/position -c 'joints/*/hinge/*' -o arm.csv
  mechanism export arm.results.h5 -c energy -o - | head
  mechanism export tones.results.h5 -c modes/frequency -c modes/damping_ratio -o tones.csv)help";

inline constexpr const char* about_channels = R"help(Lists the channels of a results file with their units.

  mechanism channels arm.results.h5
  mechanism channels arm.results.h5 -c 'nodes/position/arm/*')help";

inline constexpr const char* about_plot =
    R"help(Draws channels of results files over one another, one panel per unit (by gnuplot); modes as bars.

  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z -o tip.png
  mechanism plot coarse.results.h5 fine.results.h5 --label coarse --label fine -c energy/total -o energy.svg --range 0 2
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference 'measured.csv:t:z:measured' -o tip.png
  mechanism plot arm.results.h5 -c nodes/position/arm/tip/z --reference fine.results.h5 -o tip.pdf
  mechanism plot arm.results.h5 -c joints/coordinate -c forces --units deg,kN --size 160x100mm --font 9 -o drive.pdf
  mechanism plot tones.results.h5 -c modes/frequency -c modes/damping_ratio -o tones.png

A reference run is drawn beneath, wide and grey, channel by channel, and the difference from it in a panel of its own with its
largest value and RMS; --difference does so for a CSV reference. Where instants differ, the history that has more of them is
interpolated by cubics. --units takes units of any quantity that is drawn: mm, deg, MPa, kN, N mm, km/h, rpm, ms, %, or with its
name (length=mm); --range and --y-range count in them. A .png with a size on paper has 300 pixels per inch. Lines are solid and
bear some marks, each curve at places of its own, which tell them apart in print.)help";

inline constexpr const char* about_view =
    R"help(Makes one page that shows a run: bodies in motion, curves, report. Any browser opens it, without a network.

  mechanism view arm.results.h5 -o arm.html
  mechanism view coarse.results.h5 fine.results.h5 -o both.html
  mechanism view long.results.h5 -o long.html --instants 500 -c energy -c 'nodes/position/arm/*'
  mechanism view crank.results.h5                 crank.html
  mechanism view crank.results.h5 --stress        von Mises stress of bodies with recovery files, to colour them by
  mechanism view arm.results.h5 --paraview out

Shapes are those of the scene (`shape` of a body), sections of beams, and of superelements the surface in the recovery file
that lies beside them; else nodes and straight lines. Formats: formats/PAGE.md.)help";

inline constexpr const char* about_picture =
    R"help(Draws states of a run as a picture (png), by Chromium without a window: Debian's package chromium.

  mechanism picture arm.results.h5 --time 1.2 -o a.png
  mechanism picture arm.results.h5 --time 0 --time 0.5 --time 1 --size 1200 360 -o states.png
  mechanism picture arm.results.h5 --view -50,20 --exaggerate 20 --colour deformation --trace arm/tip -o a.png
  mechanism picture tones.results.h5 --mode 2 --phase 0 --phase 180 --show nodes --hide grid -o tone.png

It shows what the page of `mechanism view` shows. Without --time: the last instant. Where all bodies leave their place, the
camera follows the heaviest (--follow NAME, or none). A picture in which nothing is to be seen is an error.

Chromium's sandbox keeps a page from your files. Root has it not: there `picture` stops unless --no-sandbox is given.)help";

inline constexpr const char* about_compare =
    R"help(Measures channels against a reference history: largest and root-mean-square deviation.

  mechanism compare arm.results.h5 -c nodes/position/arm/tip/z --reference reference.csv:t:z --from 1 --to 5
  mechanism compare arm.results.h5 -c nodes/position/rod/end/z --reference other.csv:1:3
  mechanism compare coarse.results.h5 -c nodes/position --reference fine.results.h5

The columns of a CSV file are named, or counted from 1. A reference run is compared channel by channel.)help";

inline constexpr const char* about_study =
    R"help(Runs a scene with all combinations of settings and shows what accuracy costs in time.

  mechanism study arm.study.yaml                   table.csv, table.json and index.html in the folder arm.study
  mechanism study arm.study.yaml --tolerance 1e-3  the cheapest setting with such an error, in one line, and its scene
  mechanism study arm.study.yaml --slurm           the runs as a job array, collected when all have ended

The study file (formats/STUDY.md) names scenes, axes, quantities and the reference. A run that fails is a result. Interrupted at
any moment, the same command goes on: what has run is not repeated.
Exit codes: 0 done, 1 error, 2 wrong usage, 130 interrupted.)help";

inline constexpr const char* about_ledger =
    R"help(Sizes the effects of a scene, on or off: what each changes in the motion, and what it costs.

  mechanism ledger arm.scene.yaml
  mechanism ledger arm.scene.yaml -c nodes/position/arm/tip/z --effect stiffening --effect inertia
  mechanism ledger arm.scene.yaml --windows 1 --share 1       the whole run again with each effect the other way round
  mechanism ledger arm.scene.yaml --results arm.results.h5 --json

The scene runs once. Then, for each effect of each body (formats/SCENE.md, effects; and the inertia options of superelements),
some windows of the run are repeated from the same states with this effect alone switched (flexibility, stiffening and inertia
over the whole run, from its start), and compared: positions by the largest displacement in the scene, deflections by the
largest of their body, forces of joints by the largest of all. Times are those of the processor, the least of some
repetitions. Activity is the share of the power that flows through the effect.
Nothing is stored, and a run pays nothing for it.
Exit codes: 0 done, 1 error, 2 wrong usage, 130 interrupted.)help";

}  // namespace tisserand::mechanism::help
