// The option --tracer-timeout, of every verb that takes --tracer.
#pragma once
#include <CLI/CLI.hpp>

#include "analysis/tracers.h"

namespace plumbline {

void add_tracer_timeout(CLI::App& verb, ForeignOptions& options);

/// What a footer says of foreign tracers.
inline constexpr const char* foreign_tracers_help =
    "--tracer takes a NAME of 'plumbline tracers', or a tracer of your own (examples/README.md):\n"
    "  ./libmine.so   a shared library made with plumbline_tracer.h; any name with a '/', or ending in .so\n"
    "  pipe:CMD       a program that reads cases as JSON lines and answers each with a line, flushed:\n"
    "                 {\"id\":1,\"hit\":true}; pipe32:CMD if it reads binary32. What it promises other than closed\n"
    "                 edges and a closed range goes into brackets: pipe[edges=open,slack_relative=1e-6]:CMD, with\n"
    "                 the keys and words of 'plumbline tracers --json'\n";

}  // namespace plumbline
