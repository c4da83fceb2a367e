#include "session.h"

#include <fmt/core.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>

#include "aureole/base/error.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_interrupt(int signal) {
    g_interrupted = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void Session::add_options(CLI::App& command) {
    command.add_flag("--json", json_wanted_, "Print one JSON report on standard output");
    command.add_flag("--quiet", quiet_, "No notes, no progress bar, no summary");
    whole_number(command.add_option("--threads", threads_, "Threads to use; 0: all"), 0, 1024)
        ->type_name("N")
        ->capture_default_str();
    command.set_version_flag("--version", "aureole " AUREOLE_VERSION);
}

void Session::start() {
    limit_ = std::make_unique<ThreadLimit>(threads_);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    // A limit on file sizes shall fail as a full disk does, with a message and without debris.
    std::signal(SIGXFSZ, SIG_IGN);
}

void Session::note(const std::string& text) {
    if (quiet_ || !notes_.insert(text).second) return;
    clear_bar();
    fmt::print(stderr, "note: {}\n", text);
}

Session::Timer::~Timer() {
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    session_.seconds_[stage_] += elapsed.count();
    session_.json_["seconds"][stage_] = session_.seconds_[stage_];
}

bool Session::cancelled() const { return g_interrupted != 0; }

void Session::check_interrupt() const {
    if (cancelled()) throw Cancelled();
}

void Session::report(std::string_view stage, double fraction) {
    if (quiet_ || isatty(STDERR_FILENO) == 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (stage != bar_stage_ && !bar_shown_) {
        bar_stage_ = stage;
        bar_start_ = now;
    }
    if (now - bar_start_ < std::chrono::seconds(1)) return;
    constexpr int kWidth = 40;
    const int filled = static_cast<int>(fraction * kWidth + 0.5);
    fmt::print(stderr, "\r{:<16} [{:=<{}}{: <{}}] {:3.0f} %", stage, "", filled, "",
               kWidth - filled, 100 * fraction);
    std::fflush(stderr);
    bar_shown_ = true;
    if (fraction >= 1) clear_bar();
}

void Session::clear_bar() {
    if (!bar_shown_) return;
    fmt::print(stderr, "\r{:70}\r", "");
    bar_shown_ = false;
}

void Session::finish(const std::string& summary) {
    clear_bar();
    if (json_wanted_) {
        std::cout << json_.dump(2) << "\n";
    } else if (!quiet_) {
        std::cout << summary;
    }
    std::cout.flush();
    if (!std::cout) throw FileError("standard output", "cannot be written");
}

}  // namespace aureole::app
