// The textbook kernels, in the order in which tables show them.
#pragma once
#include "float_tracer/baldwin_weber.h"
#include "float_tracer/moller_trumbore.h"
#include "float_tracer/plucker.h"
#include "float_tracer/woop_watertight.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

/// visit.template operator()<Kernel>() of each, in binary32 and then binary64.
template <class Visit>
void for_each_kernel(Visit visit) {
  const auto both = [&visit]<template <class> class Kernel>() {
    visit.template operator()<Kernel<float>>();
    visit.template operator()<Kernel<double>>();
  };
  both.template operator()<MollerTrumbore>();
  both.template operator()<WoopWatertight>();
  both.template operator()<Plucker>();
  both.template operator()<BaldwinWeber>();
}

}  // namespace plumbline::inline PLUMBLINE_KERNELS
