// What every command shares: the options --json, --quiet and --threads, progress on the terminal,
// notes to the user, interruption, and the report at the end.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "aureole/base/parallel.h"
#include "aureole/base/progress.h"

namespace aureole::app {

class Session : public Progress {
  public:
    // Adds --json, --quiet, --threads and --version to a command.
    void add_options(CLI::App& command);
    // After parsing: applies --threads and takes over SIGINT and SIGTERM: the first asks to stop at
    // the next safe point, a second one ends the program at once.
    void start();

    // One line on standard error, unless --quiet, and only once however many frames say the same.
    // What was assumed or replaced, not errors.
    void note(const std::string& text);

    // Runs work and adds the time it took to report["seconds"][stage].
    template <class Work>
    decltype(auto) timed(const std::string& stage, const Work& work) {
        const Timer timer(*this, stage);
        return work();
    }

    // Throws Cancelled if the user asked to stop.
    void check_interrupt() const;

    // Progress: a bar on standard error when that is a terminal and the work takes longer than a
    // second.
    void report(std::string_view stage, double fraction) override;
    bool cancelled() const override;

    // The JSON report; seconds are filled in by timed().
    nlohmann::ordered_json& json() { return json_; }
    bool wants_json() const { return json_wanted_; }
    // Prints the JSON report if it was asked for; else `summary`, unless --quiet. Throws FileError
    // if standard output does not take it.
    void finish(const std::string& summary);

  private:
    class Timer {
      public:
        Timer(Session& session, std::string stage)
            : session_(session), stage_(std::move(stage)), start_(Clock::now()) {}
        ~Timer();
        Timer(const Timer&) = delete;
        Timer& operator=(const Timer&) = delete;

      private:
        using Clock = std::chrono::steady_clock;
        Session& session_;
        std::string stage_;
        Clock::time_point start_;
    };
    void clear_bar();

    bool json_wanted_ = false;
    bool quiet_ = false;
    int threads_ = 0;
    std::set<std::string> notes_;
    bool bar_shown_ = false;
    std::string bar_stage_;
    std::chrono::steady_clock::time_point bar_start_;
    std::unique_ptr<ThreadLimit> limit_;
    std::map<std::string, double> seconds_;
    nlohmann::ordered_json json_;
};

}  // namespace aureole::app
