#include "cli/interruption.h"

#include <csignal>

namespace plumbline {
namespace {

std::atomic<bool> interrupted = false;
void (*meant)(int) = SIG_DFL;  // what an interrupt did before

void interrupt(int) {
  interrupted = true;
  std::signal(SIGINT, meant);
}

}  // namespace

Interruption::Interruption() {
  meant = std::signal(SIGINT, SIG_IGN);
  std::signal(SIGINT, interrupt);
}

Interruption::~Interruption() { std::signal(SIGINT, meant); }

const std::atomic<bool>& Interruption::came() const { return interrupted; }

}  // namespace plumbline
