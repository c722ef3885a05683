#include "float_tracer/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <type_traits>
#include <vector>

#include "case/input_error.h"
#include "float_tracer/fixed_text.h"
#include "float_tracer/float_environment.h"
#include "float_tracer/fork_server.h"
#include "float_tracer/isolated.h"
#include "float_tracer/plumbline_tracer.h"

namespace plumbline {
namespace {

constexpr std::uint32_t unset = 0xdeadbeef;  // no outcome
constexpr std::size_t longest_name = 299;
constexpr std::size_t guards = 8;            // answers behind the last: a batch that overflows is seen, mostly

// The functions of one precision.
template <class Real>
struct Functions;
template <>
struct Functions<float> {
  using Ray = plumbline_ray_f32;
  static auto prepare(const plumbline_tracer_table& table) { return table.prepare_f32; }
  static auto trace(const plumbline_tracer_table& table) { return table.trace_f32; }
};
template <>
struct Functions<double> {
  using Ray = plumbline_ray_f64;
  static auto prepare(const plumbline_tracer_table& table) { return table.prepare_f64; }
  static auto trace(const plumbline_tracer_table& table) { return table.trace_f64; }
};

template <class Real>
void put(Real* to, const Vec3& v) {
  to[0] = static_cast<Real>(v.x);
  to[1] = static_cast<Real>(v.y);
  to[2] = static_cast<Real>(v.z);
}

Vec3 vec(const double* p) { return {p[0], p[1], p[2]}; }

template <class Real>
std::vector<Real> vertices(const Bag& bag) {
  std::vector<Real> numbers;
  numbers.reserve(9 * bag.triangles.size());
  for (const Triangle& t : bag.triangles)
    for (const Vec3& p : {t.a, t.b, t.c})
      for (const double x : {p.x, p.y, p.z}) numbers.push_back(static_cast<Real>(x));
  return numbers;
}

// A tail of more than half an ulp, or none at all (NaN).
bool tail_is_impossible(const Query& query) {
  const auto impossible = [](double x, double tail) { return tail != 0 && !(std::isfinite(tail) && x + tail == x); };
  const auto& [d, tail] = std::pair(query.ray.direction, query.direction_tail);
  return impossible(d.x, tail.x) || impossible(d.y, tail.y) || impossible(d.z, tail.z);
}

template <class Real>
class PluginBag final : public PreparedBag {
  using Functions = plumbline::Functions<Real>;

 public:
  PluginBag(const plumbline_tracer_table& table, const Bag& bag) : table_(table), triangles_(bag.triangles.size()) {
    const auto numbers = vertices<Real>(bag);
    bag_ = Functions::prepare(table_)(numbers.data(), triangles_);
  }
  PluginBag(const PluginBag&) = delete;
  PluginBag& operator=(const PluginBag&) = delete;
  ~PluginBag() override {
    if (!bag_) return;
    const FloatEnvironment before;
    table_.release(bag_);
    before.restore();
  }

  Query asked(const Ray& ray) override {
    if (!bag_ || !table_.asked) return ray;
    plumbline_query query{};
    put(query.origin, ray.origin);
    put(query.direction, ray.direction);
    query.t_min = ray.t_min;
    query.t_max = ray.t_max;
    const FloatEnvironment before;
    table_.asked(bag_, &query);
    if (before.restore()) conduct_.disturbed = true;
    Query said(Ray{vec(query.origin), vec(query.direction), query.t_min, query.t_max});
    said.direction_tail = vec(query.direction_tail);
    if (!tail_is_impossible(said)) return said;
    conduct_.add_breach("asked() gave a direction_tail of more than half a unit in the last place; not used");
    return ray;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    std::ranges::fill(answers, Answer{.outcome = Outcome::fault});
    if (!bag_ || rays.empty()) return;
    put_rays_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      put(put_rays_[i].origin, rays[i].origin);
      put(put_rays_[i].direction, rays[i].direction);
      put_rays_[i].t_min = static_cast<Real>(rays[i].t_min);
      put_rays_[i].t_max = static_cast<Real>(rays[i].t_max);
    }
    plumbline_answer blank{};
    blank.outcome = unset;
    said_.assign(rays.size() + guards, blank);
    const std::size_t answered = Functions::trace(table_)(bag_, put_rays_.data(), rays.size(), said_.data());
    if (const std::string lie = lie_about(answered, rays.size()); !lie.empty())
      return conduct_.add_breach(fmt::format("{}; all {} are faults", lie, rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = checked(said_[i]);
  }

  // What is wrong with a batch as a whole; empty: nothing.
  std::string lie_about(std::size_t answered, std::size_t asked) const {
    if (answered != asked) return fmt::format("trace() answered {} of {} rays", answered, asked);
    const auto is_unset = [](const plumbline_answer& a) { return a.outcome == unset; };
    const auto batch = std::span(said_).first(asked), behind = std::span(said_).subspan(asked);
    if (!std::ranges::all_of(behind, is_unset)) return fmt::format("trace() wrote behind its {} answers", asked);
    const auto it = std::ranges::find_if(batch, is_unset);
    if (it == batch.end()) return "";
    return fmt::format("trace() left the outcome of answer {} of {} unset", it - batch.begin() + 1, asked);
  }

  Answer checked(const plumbline_answer& said) {
    switch (said.outcome) {
      case PLUMBLINE_MISS:
        return {};
      case PLUMBLINE_FAULT:
        return {.outcome = Outcome::fault};
      case PLUMBLINE_HIT:
        if (said.triangle >= triangles_) {
          conduct_.add_breach(
              fmt::format("trace() hit triangle {} of {} (they count from 0); a fault", said.triangle, triangles_));
          return {.outcome = Outcome::fault};
        }
        return {.outcome = Outcome::hit,
                .has_t = said.has_t != 0,
                .has_uv = said.has_uv != 0,
                .triangle = said.triangle,
                .t = said.has_t != 0 ? said.t : 0,
                .u = said.has_uv != 0 ? said.u : 0,
                .v = said.has_uv != 0 ? said.v : 0};
      default:
        conduct_.add_breach(fmt::format(
            "trace() gave the outcome {}, which is no PLUMBLINE_MISS, HIT or FAULT; a fault", said.outcome));
        return {.outcome = Outcome::fault};
    }
  }

  const plumbline_tracer_table& table_;
  std::size_t triangles_;
  void* bag_ = nullptr;  // null: the tracer can't take the triangles
  std::vector<typename Functions::Ray> put_rays_;
  std::vector<plumbline_answer> said_;
};

[[noreturn]] void refuse(const std::string& path, std::string_view what) {
  throw InputError(fmt::format("{}: {}", path, what));
}

const plumbline_tracer_table* open(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    refuse(path, fmt::format("cannot be opened: {}; build it, or correct the path",
                             error ? error.message() : std::strerror(ENOENT)));
  if (std::filesystem::is_directory(status)) refuse(path, "is a folder; name the shared library in it");

  // Without a '/' the loader would look in the system's folders.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    std::string_view why = dlerror();
    if (why.starts_with(file + ": ")) why.remove_prefix(file.size() + 2);
    refuse(path, fmt::format("cannot be loaded: {}; link it with -shared and with all that it needs", why));
  }
  using Entry = const plumbline_tracer_table* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "plumbline_tracer"));
  if (!entry)
    refuse(path,
           "exports no function 'plumbline_tracer'; define it as plumbline_tracer.h declares it, and include that");
  const plumbline_tracer_table* const table = entry();
  if (!table) refuse(path, "plumbline_tracer() returned NULL; return the address of a static table");
  return table;
}

void check_function(const std::string& path, bool there, std::string_view name, std::string_view instead = "") {
  if (!there) refuse(path, fmt::format("in its table, the function '{}' is NULL; fill it in{}", name, instead));
}

template <class Enum>
Enum chosen(const std::string& path, std::string_view field, std::uint32_t value,
            std::initializer_list<Enum> choices) {
  if (value >= choices.size())
    refuse(path, fmt::format("describe() set {} to {}; it can be 0 to {}: see plumbline_tracer.h", field, value,
                             choices.size() - 1));
  return choices.begin()[value];
}

Contract contract_of(const std::string& path, const plumbline_description& said) {
  if (said.precision != 32 && said.precision != 64)
    refuse(path, fmt::format("describe() set precision to {}; set 32 or 64", said.precision));
  for (const auto& [field, x] :
       {std::pair("slack_absolute", said.slack_absolute), {"slack_relative", said.slack_relative}})
    if (!(x >= 0) || !std::isfinite(x))
      refuse(path, fmt::format("describe() set {} to {}; set a finite number that is not negative", field, x));
  const auto end = [&](std::string_view field, std::uint32_t value) {
    return chosen(path, field, value, {EndRule::closed, EndRule::open, EndRule::unspecified});
  };
  const auto touch = [&](std::string_view field, std::uint32_t value) {
    return chosen(path, field, value, {TouchRule::miss, TouchRule::hit, TouchRule::unspecified});
  };
  return {.precision = said.precision == 32 ? Precision::binary32 : Precision::binary64,
          .edges = chosen(path, "edges", said.edges,
                          {EdgeRule::closed, EdgeRule::open, EdgeRule::one_owner, EdgeRule::unspecified}),
          .range = chosen(path, "range", said.range, {RangeRule::given, RangeRule::ray, RangeRule::line}),
          .t_min = end("t_min", said.t_min),
          .t_max = end("t_max", said.t_max),
          .coplanar = touch("coplanar", said.coplanar),
          .degenerate = touch("degenerate", said.degenerate),
          .culling = chosen(path, "culling", said.culling, {Culling::none, Culling::back, Culling::front}),
          .slack_absolute = said.slack_absolute,
          .slack_relative = said.slack_relative};
}

std::string name_of(const std::string& path, const plumbline_description& said) {
  if (!said.name) return std::filesystem::path(path).stem().string();
  const std::string name = said.name;
  const bool one_word = std::ranges::all_of(name, [](unsigned char c) { return c > 0x20 && c != 0x7f; });
  if (name.empty() || name.size() > longest_name || !one_word)
    refuse(path, fmt::format("describe() set the name '{}'; set one word, such as my_tracer", name));
  return name;
}

struct Library {
  const plumbline_tracer_table* table;
  TracerInfo info;
};

Library load(const std::string& path) {
  const FloatEnvironment before;  // a library that was linked with -ffast-math flushes subnormals from its loading on
  const plumbline_tracer_table* const table = open(path);
  if (table->version != PLUMBLINE_TRACER_VERSION)
    refuse(path,
           fmt::format("made for version {} of plumbline_tracer.h, and this program is of version {}; compile it "
                       "with that one, and set 'version' to PLUMBLINE_TRACER_VERSION",
                       table->version, PLUMBLINE_TRACER_VERSION));
  check_function(path, table->describe, "describe");
  plumbline_description said{};
  table->describe(&said);
  before.restore();

  const Contract contract = contract_of(path, said);
  const bool single = contract.precision == Precision::binary32;
  const std::string_view instead =
      single ? ", or set precision to 64 in describe()" : ", or set precision to 32 in describe()";
  check_function(path, single ? table->prepare_f32 != nullptr : table->prepare_f64 != nullptr,
                 single ? "prepare_f32" : "prepare_f64", instead);
  check_function(path, single ? table->trace_f32 != nullptr : table->trace_f64 != nullptr,
                 single ? "trace_f32" : "trace_f64", instead);
  check_function(path, table->release, "release", ", even if it does nothing");
  return {table,
          {.name = name_of(path, said),
           .summary = said.summary ? said.summary : "",
           .source = path,
           .package = path,
           .contract = contract,
           .has_tree = true,
           .own_queries = table->asked != nullptr,
           .isolation = Isolation::process}};
}

// In the child that `isolated` makes: there the library is loaded, by the first bag.
class Plugin final : public Tracer {
 public:
  explicit Plugin(TracerInfo info) : Tracer(std::move(info)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    if (!table_) table_ = load(info().source).table;
    if (info().contract.precision == Precision::binary32) return std::make_unique<PluginBag<float>>(*table_, bag);
    return std::make_unique<PluginBag<double>>(*table_, bag);
  }

 private:
  mutable const plumbline_tracer_table* table_ = nullptr;  // a child has one thread
};

// What a child that has loaded the library says of it, in one message.
struct Description {
  char refusal[1000];  // empty: none
  char name[longest_name + 1], summary[1000];
  Contract contract;
  bool own_queries;
};
static_assert(std::is_trivially_copyable_v<Description>);

Description describe(const std::string& path) {
  Description said{};
  try {
    const TracerInfo info = load(path).info;
    copy_text(info.name, said.name);
    copy_text(info.summary, said.summary);
    said.contract = info.contract;
    said.own_queries = info.own_queries;
  } catch (const InputError& error) {
    copy_text(error.what(), said.refusal);
  }
  return said;
}

Description describe_in_child(const std::string& path, std::chrono::milliseconds timeout) {
  ForkServer server([&path](Descriptor socket, Descriptor) {
    const Description said = describe(path);
    send(socket.get(), &said, sizeof said, MSG_NOSIGNAL);
  });
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "no socket for a child process");
  const Descriptor ours(ends[0]);
  Descriptor theirs(ends[1]);
  const pid_t child = server.start(theirs.get(), theirs.get());
  if (child < 0) throw std::system_error(EAGAIN, std::generic_category(), "no child process");
  theirs = Descriptor();
  Description said;
  const bool in_time = wait_for(ours, timeout);
  const bool whole = in_time && recv(ours.get(), &said, sizeof said, 0) == sizeof said;
  const std::optional<int> status = server.end(child);
  if (!whole)
    refuse(path, fmt::format("it can't be loaded and describe itself: {}; load it in a program of yours to see why",
                             in_time && status ? cause_of_death(*status) : overdue(timeout)));
  return said;
}

}  // namespace

bool names_plugin(std::string_view name) { return name.find('/') != name.npos || name.ends_with(".so"); }

std::unique_ptr<Tracer> load_plugin(const std::string& path, double timeout) {
  const std::chrono::milliseconds limit(std::llround(std::ceil(1000 * timeout)));
  const Description said = describe_in_child(path, limit);
  if (said.refusal[0] != 0) throw InputError(said.refusal);
  return isolated(std::make_unique<Plugin>(TracerInfo{.name = said.name,
                                                      .summary = said.summary,
                                                      .source = path,
                                                      .package = path,
                                                      .contract = said.contract,
                                                      .has_tree = true,
                                                      .own_queries = said.own_queries,
                                                      .isolation = Isolation::process}),
                  {.timeout = limit});
}

}  // namespace plumbline
