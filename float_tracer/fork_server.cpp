#include "float_tracer/fork_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

namespace plumbline {
namespace {

struct Request {
  enum { start, end } what = start;
  pid_t child = -1;  // to end
};

struct Reply {
  pid_t child = -1;
  int status = 0;
};

// The descriptors that travel with a request.
union Rights {
  cmsghdr header;
  char bytes[CMSG_SPACE(2 * sizeof(int))];
};

template <class Call>
auto retried(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

bool send_request(int control, const Request& request, int socket, int memory) {
  iovec data{const_cast<Request*>(&request), sizeof request};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  Rights rights{};
  if (request.what == Request::start) {
    const int numbers[] = {socket, memory};
    message.msg_control = &rights;
    message.msg_controllen = sizeof rights;
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof numbers);
    std::memcpy(CMSG_DATA(header), numbers, sizeof numbers);
  }
  return retried([&] { return sendmsg(control, &message, MSG_NOSIGNAL); }) == sizeof request;
}

// False at the end: our process has closed its side, or is gone.
bool receive_request(int control, Request& request, Descriptor& socket, Descriptor& memory) {
  iovec data{&request, sizeof request};
  Rights rights{};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = &rights;
  message.msg_controllen = sizeof rights;
  if (retried([&] { return recvmsg(control, &message, MSG_CMSG_CLOEXEC); }) != sizeof request) return false;
  if (request.what != Request::start) return true;
  const cmsghdr* const header = CMSG_FIRSTHDR(&message);
  int numbers[2];
  if (!header || header->cmsg_len != CMSG_LEN(sizeof numbers)) return false;
  std::memcpy(numbers, CMSG_DATA(header), sizeof numbers);
  socket = Descriptor(numbers[0]);
  memory = Descriptor(numbers[1]);
  return true;
}

// Keeps `control` only, and gives it the number that is returned.
int leave_our_process(int control) {
  constexpr int kept = 3;
  setsid();
  const int copy = fcntl(control, F_DUPFD_CLOEXEC, kept + 1);
  const int null = open("/dev/null", O_RDWR);
  for (int standard = 0; standard < kept; ++standard)
    if (standard != null) dup2(null, standard);
  dup3(copy, kept, O_CLOEXEC);
  close_range(kept + 1, ~0u, 0);

  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) sigaction(signal, &by_default, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  return kept;
}

[[noreturn]] void be_child(pid_t server, const ForkServer::Work& work, Descriptor socket, Descriptor memory) {
  setpgid(0, 0);  // what it starts dies with it
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != server) _exit(0);  // it went before that
  prctl(PR_SET_DUMPABLE, 0);          // RLIMIT_CORE doesn't hold where cores go to a program
  // Code under test that calls exit must not end our objects, or write once more what our streams held.
  on_exit([](int code, void*) { _exit(code); }, nullptr);
  work(std::move(socket), std::move(memory));
  _exit(0);
}

int reap(pid_t child) {
  kill(-child, SIGKILL);
  kill(child, SIGKILL);
  int status = 0;
  retried([&] { return waitpid(child, &status, 0); });
  return status;
}

[[noreturn]] void serve(int control, const ForkServer::Work& work) {
  const pid_t server = getpid();
  std::vector<pid_t> children;
  for (;;) {
    Request request;
    Descriptor socket, memory;
    if (!receive_request(control, request, socket, memory)) break;
    Reply reply;
    if (request.what == Request::start) {
      reply.child = fork();
      if (reply.child == 0) {
        close(control);
        be_child(server, work, std::move(socket), std::move(memory));
      }
      if (reply.child > 0) children.push_back(reply.child);
    } else if (std::erase(children, request.child) != 0) {  // no other process, whatever we are told
      reply = {request.child, reap(request.child)};
    }
    if (retried([&] { return send(control, &reply, sizeof reply, MSG_NOSIGNAL); }) < 0) break;
  }
  for (const pid_t child : children) reap(child);
  _exit(0);
}

}  // namespace

ForkServer::ForkServer(Work work) : owner_(getpid()) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "no socket for a child process");
  control_ = Descriptor(ends[0]);
  const Descriptor theirs(ends[1]);
  server_ = fork();
  if (server_ < 0) throw std::system_error(errno, std::generic_category(), "no child process");
  if (server_ == 0) serve(leave_our_process(theirs.get()), work);
}

ForkServer::~ForkServer() {
  if (getpid() != owner_) return;
  control_ = Descriptor();  // which ends it
  retried([&] { return waitpid(server_, nullptr, 0); });
}

pid_t ForkServer::start(int socket, int memory) {
  const std::lock_guard lock(mutex_);
  Reply reply;
  if (getpid() != owner_) return -1;
  if (!send_request(control_.get(), {Request::start, -1}, socket, memory)) return -1;
  if (retried([&] { return recv(control_.get(), &reply, sizeof reply, 0); }) != sizeof reply) return -1;
  return reply.child;
}

std::optional<int> ForkServer::end(pid_t child) {
  const std::lock_guard lock(mutex_);
  Reply reply;
  if (getpid() != owner_) return std::nullopt;  // forked off: the server isn't ours
  if (!send_request(control_.get(), {Request::end, child}, -1, -1)) return std::nullopt;
  if (retried([&] { return recv(control_.get(), &reply, sizeof reply, 0); }) != sizeof reply) return std::nullopt;
  if (reply.child != child) return std::nullopt;
  return reply.status;
}

bool wait_for(const Descriptor& socket, std::chrono::milliseconds timeout) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + timeout;
  pollfd wanted{socket.get(), POLLIN, 0};
  for (;;) {
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    // Once more at the end: we may have been stopped, and it not.
    const int ready = poll(&wanted, 1, static_cast<int>(std::clamp<decltype(rest)>(rest, 0, 1 << 30)));
    if (ready > 0) return true;
    if (ready == 0 && rest <= 0) return false;
    if (ready < 0 && errno != EINTR) return true;
  }
}

std::string cause_of_death(int status) {
  if (WIFEXITED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
  const char* const name = WIFSIGNALED(status) ? sigabbrev_np(WTERMSIG(status)) : nullptr;
  return name ? std::string("SIG") + name : "status " + std::to_string(status);
}

std::string overdue(std::chrono::milliseconds timeout) {
  const auto ms = timeout.count();
  return "no answer within " + (ms % 1000 == 0 ? std::to_string(ms / 1000) + " s" : std::to_string(ms) + " ms");
}

}  // namespace plumbline
