#!/bin/bash -eu
# Builds the fuzz programs for ClusterFuzzLite and OSS-Fuzz, from what their images set and nothing else: $CC, $CXX,
# $CFLAGS, $CXXFLAGS, $LIB_FUZZING_ENGINE, and the folders $SRC, $WORK and $OUT. All are one program; its name tells
# the tracer.
#
# A program aborts at a finding that is worse than what is known of its tracer: fuzz/known/TARGET.case.
targets="moller_trumbore_f32 moller_trumbore_f64 woop_watertight_f32 woop_watertight_f64 plucker_f32 plucker_f64
         baldwin_weber_f32 baldwin_weber_f64 brlcad_bot_classic_target"

source=$SRC/plumbline
build=$WORK/plumbline
# The build type None has no flags of its own: those of the image hold, optimisation and instrumentation included.
# Coverage steers nothing here, but a service takes a program without for one that was built wrong.
cmake -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=None -DPLUMBLINE_SERVICE=ON -DPLUMBLINE_ADAPTERS= \
      -DPLUMBLINE_TESTS=OFF -DPLUMBLINE_FUZZING_ENGINE="$LIB_FUZZING_ENGINE"
cmake --build "$build" --parallel "$(nproc)" --target plumbline_fuzzer

for target in $targets; do
  program=$OUT/fuzz_$target
  cp "$build/fuzz/plumbline_fuzzer" "$program"
  cp "$source/fuzz/known/$target.case" "${program}_baseline.case"
  # Seeds: of the known and the hard cases, those that are the worst of their cell, as inputs.
  campaign=$WORK/seeds/$target
  rm -rf "$campaign" "${program}_seed_corpus.zip"
  "$program" --record --campaign="$campaign" --seeds="$source/corpus/hard" -runs=0
  zip -q -j -r "${program}_seed_corpus.zip" "$campaign/elites"
  size=$(stat -c %s "$(find "$campaign/elites" -type f | head -n 1)")
  printf '[libfuzzer]\nmax_len = %s\nlen_control = 0\n' "$size" >"$program.options"
done
