#include "float_tracer/isolated.h"

#include <sys/mman.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <type_traits>

#include "float_tracer/descriptor.h"
#include "float_tracer/fixed_text.h"
#include "float_tracer/float_environment.h"
#include "float_tracer/fork_server.h"

namespace plumbline {
namespace {

constexpr std::size_t largest_batch = 65536;

// ---- The shared memory: a job, then its triangles, rays, answers and, of a tracer with own queries, these.

struct Job {
  // From us:
  FloatEnvironment environment;  // to work under
  std::uint64_t bag = 0;         // its number; never 0
  std::size_t triangles = 0, rays = 0;
  BagMode mode{};  // these five are the bag's
  double thickness = 0;
  PlatePosition position{};
  bool cosine = false;
  Orientation orientation{};
  bool one_by_one = false;
  std::size_t first = 0;  // ray to begin with

  // From the child, who may die at any time:
  std::atomic<bool> building = false;
  std::atomic<std::size_t> at = 0;  // the ray under way; the answers before it are there, if one by one
  bool disturbed = false, threw = false;
  char what[200] = {};
  std::size_t breaches = 0;
  struct Breach {
    char what[184];
    std::uint64_t times;
  } breach[Conduct::told_apart + 1];
};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);
static_assert(std::is_trivially_copyable_v<Triangle> && std::is_trivially_copyable_v<Ray> &&
              std::is_trivially_copyable_v<Answer> && std::is_trivially_copyable_v<Query>);

class SharedMemory {
 public:
  SharedMemory(const Descriptor& file, std::size_t size) : size_(size) {
    start_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
    if (start_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "no shared memory");
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() { munmap(start_, size_); }

  std::size_t size() const { return size_; }
  Job& job() { return *static_cast<Job*>(start_); }
  Triangle* triangles() { return reinterpret_cast<Triangle*>(&job() + 1); }
  Ray* rays() { return reinterpret_cast<Ray*>(triangles() + job().triangles); }
  Answer* answers() { return reinterpret_cast<Answer*>(rays() + job().rays); }
  Query* queries() { return reinterpret_cast<Query*>(answers() + job().rays); }

  static std::size_t size_for(std::size_t triangles, std::size_t rays, bool queries) {
    return sizeof(Job) + triangles * sizeof(Triangle) + rays * (sizeof(Ray) + sizeof(Answer)) +
           (queries ? rays * sizeof(Query) : 0);
  }

 private:
  void* start_;
  std::size_t size_;
};
static_assert(alignof(Job) <= 64 && sizeof(Job) % 8 == 0 && alignof(Answer) == 8 && alignof(Query) == 8);

// ---- In the child.

Bag bag_of(SharedMemory& memory) {
  const Job& job = memory.job();
  Bag bag{.triangles = {memory.triangles(), memory.triangles() + job.triangles},
          .mode = job.mode,
          .thickness = job.thickness,
          .position = job.position,
          .cosine = job.cosine,
          .orientation = job.orientation};
  return bag;
}

struct Prepared {
  std::unique_ptr<PreparedBag> bag;
  std::uint64_t number = 0;
};

void tell(const Conduct& conduct, Job& job) {
  job.disturbed = conduct.disturbed;
  job.breaches = 0;
  for (const auto& [what, times] : conduct.breaches) {
    Job::Breach& breach = job.breach[job.breaches++];
    copy_text(what, breach.what);
    breach.times = times;
  }
}

void do_job(const Tracer& tracer, Prepared& prepared, SharedMemory& memory) {
  Job& job = memory.job();
  const FloatEnvironment environment = job.environment;
  environment.restore();
  Conduct conduct;  // during this job
  const auto tidy_up = [&] {
    conduct += prepared.bag->take_conduct();
    if (environment.restore()) conduct.disturbed = true;
    tell(conduct, job);
  };
  if (prepared.number != job.bag) {
    job.building = true;
    prepared.bag.reset();
    prepared.bag = tracer.prepare(bag_of(memory));
    prepared.number = job.bag;
    tidy_up();
    job.building = false;
  }
  const std::span rays(memory.rays(), job.rays);
  const std::span answers(memory.answers(), job.rays);
  Query* const queries = tracer.info().own_queries ? memory.queries() : nullptr;
  const std::size_t step = job.one_by_one ? 1 : std::max<std::size_t>(1, rays.size());
  for (std::size_t i = job.first; i < rays.size(); i += step) {
    job.at = i;
    prepared.bag->trace(rays.subspan(i, step), answers.subspan(i, step));
    if (queries)
      for (std::size_t k = i; k < i + step; ++k) queries[k] = prepared.bag->asked(rays[k]);
    tidy_up();
  }
  job.at = rays.size();
}

void work(const Tracer& tracer, Descriptor socket, Descriptor file) {
  std::optional<SharedMemory> memory;
  Prepared prepared;
  std::size_t size;  // of the memory, sent with each job
  while (recv(socket.get(), &size, sizeof size, 0) == sizeof size) {
    if (!memory || memory->size() != size) memory.emplace(file, size);
    try {
      do_job(tracer, prepared, *memory);
    } catch (const std::exception& error) {
      copy_text(error.what(), memory->job().what);
      memory->job().threw = true;
      _exit(1);  // as if it had died of it: what it holds may be broken
    } catch (...) {
      memory->job().threw = true;
      _exit(1);
    }
    if (send(socket.get(), &size, sizeof size, MSG_NOSIGNAL) < 0) return;
  }
}

// ---- At home.

struct Death {
  std::string cause;
  bool building = false;
  std::size_t at = 0;
};

class Child {
 public:
  /// Throws std::system_error.
  explicit Child(std::shared_ptr<ForkServer> server) : server_(std::move(server)) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("no socket for a child process");
    socket_ = Descriptor(ends[0]);
    const Descriptor theirs(ends[1]);
    file_ = Descriptor(memfd_create("plumbline", MFD_CLOEXEC));
    if (file_.get() < 0) fail("no shared memory");
    process_ = server_->start(theirs.get(), file_.get());
    if (process_ < 0) {
      errno = EAGAIN;
      fail("no child process");
    }
  }
  ~Child() {
    if (process_ >= 0) server_->end(process_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool fresh() const { return fresh_; }
  std::uint64_t bag() const { return bag_; }

  /// Room for a job. Grows in large steps only.
  SharedMemory& memory(std::size_t size) {
    if (!memory_ || memory_->size() < size) {
      const std::size_t grown = std::max<std::size_t>(size + size / 2, 1 << 16);
      if (ftruncate(file_.get(), static_cast<off_t>(grown)) != 0) fail("no shared memory");
      memory_.emplace(file_, grown);
    }
    return *memory_;
  }

  /// Has it do the job in its memory. After a death it is of no further use.
  std::optional<Death> run(std::chrono::milliseconds timeout) {
    fresh_ = false;
    bag_ = memory_->job().bag;
    const std::size_t size = memory_->size();
    if (send(socket_.get(), &size, sizeof size, MSG_NOSIGNAL) < 0) return death(false, timeout);
    for (std::size_t at = memory_->job().first; !wait_for(socket_, timeout);) {
      const std::size_t now = memory_->job().at;
      if (now == at || !memory_->job().one_by_one) return death(true, timeout);
      at = now;
    }
    std::size_t echo;
    if (recv(socket_.get(), &echo, sizeof echo, 0) != sizeof echo) return death(false, timeout);
    return std::nullopt;
  }

 private:
  [[noreturn]] static void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

  Death death(bool hung, std::chrono::milliseconds timeout) {
    const std::optional<int> status = server_->end(std::exchange(process_, -1));
    const Job& job = memory_->job();
    Death death{.cause = {}, .building = job.building, .at = std::clamp<std::size_t>(job.at, job.first, job.rays)};
    if (hung) {
      death.cause = overdue(timeout);
    } else if (job.threw) {
      const std::string what = text_in(job.what);
      death.cause = what.empty() ? "an exception" : "exception: " + what;
    } else {
      death.cause = status ? cause_of_death(*status) : "killed with its server";
    }
    return death;
  }

  std::shared_ptr<ForkServer> server_;
  Descriptor socket_, file_;
  std::optional<SharedMemory> memory_;
  pid_t process_ = -1;
  bool fresh_ = true;
  std::uint64_t bag_ = 0;
};

// The wrapped tracer with its children; shared by the bags. Thread-safe.
class Household {
 public:
  Household(std::unique_ptr<Tracer> tracer, IsolationLimits limits) : tracer_(std::move(tracer)), limits_(limits) {}

  const TracerInfo& info() const { return tracer_->info(); }
  std::chrono::milliseconds timeout() const { return limits_.timeout; }
  std::uint64_t next_bag() { return ++bags_; }

  std::shared_ptr<ForkServer> server() {
    const std::lock_guard lock(mutex_);
    return locked_server();
  }

  /// One that is idle, if possible the one that has this bag; else a fresh one.
  std::unique_ptr<Child> any(std::uint64_t bag) {
    {
      const std::lock_guard lock(mutex_);
      auto it = std::ranges::find(idle_, bag, [](const auto& child) { return child->bag(); });
      if (it == idle_.end()) it = idle_.begin();  // the longest idle
      if (it != idle_.end()) {
        auto child = std::move(*it);
        idle_.erase(it);
        return child;
      }
    }
    return fresh();
  }

  /// Throws std::system_error.
  std::unique_ptr<Child> fresh() {
    try {
      return std::make_unique<Child>(server());
    } catch (const std::system_error&) {
      const std::lock_guard lock(mutex_);  // the server may have been killed; its children are dead then
      idle_.clear();
      server_.reset();
    }
    return std::make_unique<Child>(server());
  }

  void give_back(std::unique_ptr<Child> child) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(child));
  }

 private:
  std::shared_ptr<ForkServer> locked_server() {
    if (!server_)
      server_ = std::make_shared<ForkServer>(
          [this](Descriptor socket, Descriptor memory) { work(*tracer_, std::move(socket), std::move(memory)); });
    return server_;
  }

  std::unique_ptr<Tracer> tracer_;
  IsolationLimits limits_;
  std::atomic<std::uint64_t> bags_ = 0;
  std::mutex mutex_;
  std::shared_ptr<ForkServer> server_;
  std::vector<std::unique_ptr<Child>> idle_;
};

class IsolatedBag final : public PreparedBag {
 public:
  IsolatedBag(std::shared_ptr<Household> household, Bag bag)
      : household_(std::move(household)), bag_(std::move(bag)), number_(household_->next_bag()) {}

  Query asked(const Ray& ray) override {
    if (!household_->info().own_queries) return ray;
    // Callers ask in the order in which they shot.
    for (std::size_t tries = 0; tries < shot_.size(); ++tries) {
      next_asked_ = next_asked_ % shot_.size();
      const std::size_t i = next_asked_++;
      if (std::memcmp(&shot_[i], &ray, sizeof ray) == 0) return queries_[i];
    }
    Answer answer;
    Query query = ray;
    std::map<std::string, std::uint64_t> counted = conduct_.deaths;
    trace_chunk({&ray, 1}, {&answer, 1}, &query);
    conduct_.deaths = std::move(counted);  // a question is no shot
    return query;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    const bool queries = household_->info().own_queries;
    if (queries) {
      shot_.assign(rays.begin(), rays.end());
      queries_.assign(rays.begin(), rays.end());
      next_asked_ = 0;
    }
    for (std::size_t i = 0; i < rays.size(); i += largest_batch) {
      const std::size_t n = std::min(largest_batch, rays.size() - i);
      trace_chunk(rays.subspan(i, n), answers.subspan(i, n), queries ? &queries_[i] : nullptr);
    }
  }

  void trace_chunk(std::span<const Ray> rays, std::span<Answer> answers, Query* queries) {
    std::size_t first = 0;
    try {
      trace_with_children(rays, answers, queries, first);
    } catch (const std::system_error& error) {  // there is no child, or no memory: nothing that a tracer did
      fault(answers.subspan(first), error.what());
    }
  }

  // `first` is the first ray without its answer.
  void trace_with_children(std::span<const Ray> rays, std::span<Answer> answers, Query* queries, std::size_t& first) {
    if (!dead_of_bag_.empty()) return fault(answers, dead_of_bag_);
    auto child = household_->any(number_);
    bool one_by_one = rays.size() == 1;
    while (first < rays.size()) {
      if (!child) child = household_->fresh();
      const bool fresh = child->fresh();
      SharedMemory& memory = fill(*child, rays, one_by_one, first);
      const std::optional<Death> death = child->run(household_->timeout());
      if (!death || one_by_one) take_conduct_from(memory.job());  // else all of it is done again
      const std::size_t end = !death ? rays.size() : one_by_one && !death->building ? death->at : first;
      std::copy(memory.answers() + first, memory.answers() + end,
                answers.begin() + static_cast<std::ptrdiff_t>(first));
      if (queries) std::copy(memory.queries() + first, memory.queries() + end, queries + first);
      if (!death) {
        first = end;
        break;
      }
      child.reset();
      if (fresh && death->building) {
        dead_of_bag_ = death->cause;
        return fault(answers.subspan(first), dead_of_bag_);
      }
      if (fresh && one_by_one && end == first) {
        fault(answers.subspan(first, 1), death->cause);
        ++first;
      } else {
        first = end;
      }
      one_by_one = true;
    }
    if (child) household_->give_back(std::move(child));
  }

  void take_conduct_from(const Job& job) {
    if (job.disturbed) conduct_.disturbed = true;
    for (const auto& [what, times] : std::span(job.breach).first(std::min(job.breaches, std::size(job.breach))))
      conduct_.add_breach(text_in(what), times);
  }

  SharedMemory& fill(Child& child, std::span<const Ray> rays, bool one_by_one, std::size_t first) {
    const auto& [triangles, mode, thickness, position, cosine, orientation] = bag_;
    const std::uint64_t known = child.bag();
    SharedMemory& memory =
        child.memory(SharedMemory::size_for(triangles.size(), rays.size(), household_->info().own_queries));
    Job& job = *new (&memory.job()) Job;
    job.bag = number_;
    job.triangles = triangles.size();
    job.rays = rays.size();
    job.mode = mode;
    job.thickness = thickness;
    job.position = position;
    job.cosine = cosine;
    job.orientation = orientation;
    job.one_by_one = one_by_one;
    job.first = first;
    job.at = first;
    if (known != number_) std::ranges::copy(triangles, memory.triangles());
    std::ranges::copy(rays, memory.rays());
    return memory;
  }

  void fault(std::span<Answer> answers, const std::string& cause) {
    std::ranges::fill(answers, Answer{.outcome = Outcome::fault});
    if (!answers.empty()) conduct_.deaths[cause] += answers.size();
  }

  std::shared_ptr<Household> household_;
  Bag bag_;
  std::uint64_t number_;
  std::string dead_of_bag_;  // of what, once it is known that every child dies of this bag
  std::vector<Ray> shot_;    // the last batch, of a tracer with own queries
  std::vector<Query> queries_;
  std::size_t next_asked_ = 0;
};

class IsolatedTracer final : public Tracer {
 public:
  IsolatedTracer(TracerInfo info, std::unique_ptr<Tracer> tracer, IsolationLimits limits)
      : Tracer(std::move(info)), household_(std::make_shared<Household>(std::move(tracer), limits)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    household_->server();  // early: see fork_server.h
    return std::make_unique<IsolatedBag>(household_, bag);
  }

 private:
  std::shared_ptr<Household> household_;
};

}  // namespace

std::unique_ptr<Tracer> isolated(std::unique_ptr<Tracer> tracer, IsolationLimits limits) {
  TracerInfo info = tracer->info();
  info.isolation = Isolation::process;
  return std::make_unique<IsolatedTracer>(std::move(info), std::move(tracer), limits);
}

}  // namespace plumbline
