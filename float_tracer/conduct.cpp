#include "float_tracer/conduct.h"

namespace plumbline {

void Conduct::add_breach(const std::string& what, std::uint64_t times) {
  const bool room = breaches.size() < told_apart || breaches.contains(what);
  breaches[room ? what : "broke plumbline_tracer.h in further ways"] += times;
}

Conduct& Conduct::operator+=(const Conduct& more) {
  disturbed = disturbed || more.disturbed;
  for (const auto& [cause, rays] : more.deaths) deaths[cause] += rays;
  for (const auto& [what, times] : more.breaches) add_breach(what, times);
  return *this;
}

std::string complaints(std::string_view tracer, const Conduct& conduct) {
  std::string text;
  if (!conduct.deaths.empty()) {
    std::uint64_t rays = 0;
    std::string causes;
    for (const auto& [cause, count] : conduct.deaths) {
      rays += count;
      if (!causes.empty()) causes += ", ";
      causes += cause;
      if (conduct.deaths.size() > 1) causes += ": " + std::to_string(count);
    }
    text.append(tracer).append(": died of ").append(std::to_string(rays)).append(rays == 1 ? " ray (" : " rays (");
    text.append(causes).append(rays == 1 ? "); it is a fault\n" : "); these are faults\n");
  }
  for (const auto& [what, times] : conduct.breaches) {
    text.append(tracer).append(": ").append(what);
    if (times > 1) text.append(" (").append(std::to_string(times)).append(" times)");
    text += '\n';
  }
  if (conduct.disturbed) text.append(tracer).append(": left the floating-point controls changed\n");
  return text;
}

}  // namespace plumbline
