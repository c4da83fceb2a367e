// How `aureole ibl` filters: --levels, --mapping, --method and what belongs to the methods.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/prefilter.h"
#include "aureole/ibl/progressive.h"
#include "session.h"

namespace aureole::app {

class FilterOptions {
  public:
    void add_options(CLI::App& command);
    // Throws InvalidArgument for options that the method does not know, or levels that a map of
    // `size` texels per side does not have.
    void check(int size) const;

    const std::string& method() const { return method_; }
    // Perceptual roughness of each level.
    std::vector<double> roughness(int size) const;

    // With progress. Throws Cancelled.
    ibl::CubeChain filter(const ibl::CubeMap& environment, Session& session) const;
    // The same levels without approximation.
    ibl::CubeChain filter_exactly(const ibl::CubeMap& environment, Session& session) const;
    nlohmann::ordered_json parameters(int size) const;

  private:
    bool samples_are_used() const { return method_ != "gather" && method_ != "exact"; }
    ibl::PrefilterOptions prefilter_options(int size) const;
    ibl::CubeChain filter_progressively(const ibl::CubeMap& environment, Session& session) const;

    int levels_ = 0;  // 0: those that the mapping usually has
    std::string mapping_ = "filament";
    std::string method_ = "gather";
    std::string quality_ = "normal";
    std::vector<int> samples_;
    std::string sequence_{
        ibl::kSampleSequenceNames[static_cast<std::size_t>(ibl::ProgressiveOptions().sequence)]};
    double fis_overlap_ = 1;
    double fis_bias_ = 0;
    CLI::Option* quality_option_ = nullptr;
    CLI::Option* sequence_option_ = nullptr;
    std::vector<CLI::Option*> fis_options_;
};

}  // namespace aureole::app
