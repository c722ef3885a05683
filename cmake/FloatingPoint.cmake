# Floating-point semantics are a property of a target, never of a command line: the same source under other flags is
# another tracer with other answers.

# Every library of ours: IEEE 754 binary64/binary32, each operation rounded once, in source order.
# On x86-64 the baseline has no FMA; on targets that have it, contraction must be forbidden explicitly.
add_library(plumbline_strict_fp INTERFACE)
add_library(plumbline::strict_fp ALIAS plumbline_strict_fp)
target_compile_options(plumbline_strict_fp INTERFACE -ffp-contract=off -fno-fast-math)
# g++ 12's vectorizer of straight-line code loses roundings: (double)(float)x of two neighbours becomes a copy.
target_compile_options(plumbline_strict_fp INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
# clang takes DAZ to be off and turns a test of bits, (bits & ~sign) == 0, into a comparison of floats, which under DAZ
# calls every subnormal zero. This keeps it from doing so.
target_compile_options(plumbline_strict_fp INTERFACE $<$<CXX_COMPILER_ID:Clang>:-fdenormal-fp-math=dynamic>)
