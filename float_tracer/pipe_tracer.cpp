#include "float_tracer/pipe_tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <mutex>
#include <vector>

#include "case/case_json.h"
#include "case/case_lines.h"
#include "case/contract_text.h"
#include "case/input_error.h"
#include "float_tracer/child_program.h"
#include "float_tracer/complaints.h"

namespace plumbline {
namespace {

constexpr std::size_t batch_size = 256;
constexpr unsigned give_up_after = 20;  // faults in a row

using Clock = ChildProgram::Clock;

struct Program {
  explicit Program(const std::string& command) : child(command), reader("its output") {}

  ChildProgram child;
  AnswerReader reader;
  std::uint64_t next_id = 1;
  bool fresh = true;  // has answered nothing
};

// What the tracer and its bags share: the programs that nobody is asking just now.
class Programs {
 public:
  Programs(const std::string& name, std::string command, double timeout)
      : complaints(name), timeout_(timeout), command_(std::move(command)) {}
  ~Programs() {
    for (const auto& program : idle_)
      if (program->child.finish()) complaints.add("it wrote more lines than it was asked cases");
  }

  std::unique_ptr<Program> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto program = std::move(idle_.back());
        idle_.pop_back();
        return program;
      }
    }
    return std::make_unique<Program>(command_);
  }
  void give_back(std::unique_ptr<Program> program) {
    program->fresh = false;
    faults_in_a_row_ = 0;
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(program));
  }

  bool given_up() const { return faults_in_a_row_ >= give_up_after; }
  void count_fault() {
    if (++faults_in_a_row_ == give_up_after)
      complaints.insist(fmt::format("{} faults in a row: given up, the rest are faults too", give_up_after));
  }

  double timeout() const { return timeout_; }
  const std::string& command() const { return command_; }

  Complaints complaints;

 private:
  const double timeout_;
  const std::string command_;
  std::atomic<unsigned> faults_in_a_row_ = 0;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Program>> idle_;
};

std::string question(std::uint64_t id, const Case& asked) {
  std::string line;
  JsonObject object(line);
  object.member("id") += fmt::to_string(id);
  add_members(object, asked);
  object.end_line();
  return line;
}

// A number, or a string that holds one; 0: neither.
std::uint64_t number_of(std::string_view id) {
  if (id.size() >= 2 && id.front() == '"') id = id.substr(1, id.size() - 2);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  return error == std::errc() && end == id.data() + id.size() ? number : 0;
}

// One program, and a batch of cases that differ in the ray alone.
class Exchange {
 public:
  Exchange(Program& program, Case& asked, std::span<const Ray> rays, std::span<Answer> answers)
      : program_(program), rays_(rays), answers_(answers), answered_(rays.size()), first_(program.next_id) {
    std::string text;
    for (const Ray& ray : rays) {
      asked.ray = ray;
      text += question(program.next_id++, asked);
    }
    program.child.send(text);
    triangles_ = asked.bag.triangles.size();
  }

  // False: what() tells why.
  bool run(double timeout) {
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
    for (std::size_t left = rays_.size(); left > 0; --left)
      if (!take_answer(deadline, timeout)) return false;
    if (!program_.child.has_more()) return true;
    return take_surplus(Clock::now());
  }

  const std::string& what() const { return what_; }
  bool late() const { return late_; }
  bool answered(std::size_t i) const { return answered_[i]; }

 private:
  bool fail(std::string what) {
    what_ = std::move(what);
    return false;
  }

  bool take_answer(Clock::time_point deadline, double timeout) {
    switch (read_line(deadline)) {
      case ChildProgram::Got::line:
        break;
      case ChildProgram::Got::end:
        return fail(fmt::format("it ended without an answer ({})", program_.child.end_of_it()));
      case ChildProgram::Got::late:
        late_ = true;
        return fail(fmt::format("no answer within {} s; does it flush its output after each line?", timeout));
      case ChildProgram::Got::endless:
        return fail("it writes a line that doesn't end; write one JSON object a line");
    }
    AnswerLine said;
    try {
      said = program_.reader.read(line_);
    } catch (const InputError& error) {
      return fail(error.what());
    }
    const std::uint64_t index = number_of(said.id) - first_;  // wraps around for those before
    if (index >= rays_.size())
      return fail(
          fmt::format("an answer with the id {}, and the cases asked are {} to {}; answer each line once, with "
                      "its id",
                      said.id, first_, first_ + rays_.size() - 1));
    if (answered_[index]) {
      answered_[index] = false;  // which of them should be believed?
      return fail(fmt::format("two answers with the id {}; answer each line once", said.id));
    }
    if (said.answer.outcome == Outcome::hit && said.answer.triangle >= triangles_)
      return fail(
          fmt::format("triangle_index {} of {} triangles; they count from 0", said.answer.triangle, triangles_));
    answers_[index] = said.answer;
    answered_[index] = true;
    return true;
  }

  // After the last answer. It fails; whichever case it is about is not answered.
  bool take_surplus(Clock::time_point now) {
    take_answer(now, 0);
    if (std::ranges::all_of(answered_, std::identity{})) answered_.back() = false;
    late_ = false;
    return fail("more lines than cases; answer each line once");
  }

  ChildProgram::Got read_line(Clock::time_point deadline) {
    ChildProgram::Got got;
    do got = program_.child.next_line(line_, deadline);
    while (got == ChildProgram::Got::line && line_.find_first_not_of(" \t\r") == line_.npos);
    return got;
  }

  Program& program_;
  std::span<const Ray> rays_;
  std::span<Answer> answers_;
  std::vector<bool> answered_;
  const std::uint64_t first_;
  std::size_t triangles_ = 0;
  std::string line_, what_;
  bool late_ = false;
};

class PipeBag final : public PreparedBag {
 public:
  PipeBag(Programs& programs, const Bag& bag, Precision precision) : programs_(programs) {
    asked_.bag = bag;
    asked_.precision = precision;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); i += batch_size) {
      const std::size_t n = std::min(batch_size, rays.size() - i);
      try {
        ask(rays.subspan(i, n), answers.subspan(i, n));
      } catch (const InputError& error) {  // it can't be started again
        programs_.complaints.add(error.what());
        std::ranges::fill(answers.subspan(i, n), Answer{.outcome = Outcome::fault});
      }
    }
  }

  void ask(std::span<const Ray> rays, std::span<Answer> answers) {
    std::ranges::fill(answers, Answer{.outcome = Outcome::fault});
    if (programs_.given_up()) return;
    auto program = programs_.take();
    Exchange exchange(*program, asked_, rays, answers);
    if (exchange.run(programs_.timeout())) return programs_.give_back(std::move(program));

    // Whose fault is it? Unless there is but one case, and no earlier one that may have left something behind, each
    // is asked again, alone.
    const bool certain = rays.size() == 1 && (program->fresh || exchange.late());
    program.reset();
    if (certain) return blame(exchange.what(), answers[0]);
    programs_.complaints.add(fmt::format("{}; it is started anew", exchange.what()));
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!exchange.answered(i)) ask_alone(rays.subspan(i, 1), answers.subspan(i, 1));
  }

  void ask_alone(std::span<const Ray> ray, std::span<Answer> answer) {
    for (bool again = true; again;) {
      answer[0] = {.outcome = Outcome::fault};
      if (programs_.given_up()) return;
      auto program = programs_.take();
      Exchange exchange(*program, asked_, ray, answer);
      if (exchange.run(programs_.timeout())) return programs_.give_back(std::move(program));
      again = !program->fresh && !exchange.late();
      if (!again) blame(exchange.what(), answer[0]);
    }
  }

  void blame(std::string_view what, Answer& answer) {
    answer = {.outcome = Outcome::fault};
    std::string line = question(0, asked_);  // the ray asked last is this one
    line.pop_back();
    programs_.complaints.add(fmt::format("{}; a fault: {}", what, line));
    programs_.count_fault();
  }

  Programs& programs_;
  Case asked_;
};

class PipeTracer final : public Tracer {
 public:
  PipeTracer(std::unique_ptr<Programs> programs, TracerInfo info)
      : Tracer(std::move(info)), programs_(std::move(programs)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PipeBag>(*programs_, bag, info().contract.precision);
  }

 private:
  std::unique_ptr<Programs> programs_;
};

// Told now, not as a fault of every case.
void check_that_it_answers(Programs& programs, const std::string& name, Precision precision) {
  Case easy;
  easy.precision = precision;
  easy.bag.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Ray ray = {{0.25, 0.25, 1}, {0, 0, -1}};
  Answer answer;
  auto program = programs.take();
  Exchange exchange(*program, easy, {&ray, 1}, {&answer, 1});
  if (exchange.run(programs.timeout())) return programs.give_back(std::move(program));
  std::string line = question(1, easy);
  line.pop_back();
  throw InputError(fmt::format("{}: {}; try: echo '{}' | {}", name, exchange.what(), line, programs.command()));
}

struct Parsed {
  Contract contract;
  std::string command;
};

// KIND:COMMAND or KIND[CONTRACT]:COMMAND
Parsed parsed(const std::string& name) {
  Parsed r;
  r.contract.precision = name.starts_with("pipe32") ? Precision::binary32 : Precision::binary64;
  std::size_t end = name.find_first_of(":[");
  if (name[end] == '[') {
    const std::size_t begin = end + 1;
    end = name.find("]:", begin);
    if (end == name.npos)
      throw InputError(fmt::format("{}: no ']:' behind the '['; write 'pipe[edges=open]:./my_program'", name));
    try {
      r.contract = changed(r.contract, std::string_view(name).substr(begin, end - begin));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", name, error.what()));
    }
    ++end;
  }
  r.command = name.substr(end + 1);
  return r;
}

}  // namespace

std::unique_ptr<Tracer> pipe_tracer(const std::string& name, double timeout) {
  auto [contract, command] = parsed(name);
  if (command.find_first_not_of(" \t") == command.npos)
    throw InputError(fmt::format("{}: no command; write --tracer 'pipe:./my_program'", name));
  auto programs = std::make_unique<Programs>(name, command, timeout);
  check_that_it_answers(*programs, name, contract.precision);
  // It is in a process of its own already: it needs no isolation.
  return std::make_unique<PipeTracer>(std::move(programs), TracerInfo{.name = name,
                                                                      .summary = "a program that is asked by a pipe",
                                                                      .source = command,
                                                                      .package = command,
                                                                      .contract = contract,
                                                                      .has_tree = true});
}

}  // namespace plumbline
