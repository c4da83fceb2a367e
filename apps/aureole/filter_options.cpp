#include "filter_options.h"

#include <fmt/core.h>

#include <algorithm>

#include "aureole/base/error.h"
#include "aureole/ibl/roughness.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr int kMostLevels = 15;
constexpr int kMostSamples = 65536;
constexpr int kSamplesPerPass = 32;

template <std::size_t N>
std::vector<std::string> words(const std::array<std::string_view, N>& names) {
    return {names.begin(), names.end()};
}

// The value of an enumeration whose names are listed in its order.
template <class Enum, std::size_t N>
Enum named(const std::array<std::string_view, N>& names, const std::string& name) {
    return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

void FilterOptions::add_options(CLI::App& command) {
    CLI::Option_group& group = *command.add_option_group("Filtering");
    whole_number(group.add_option("--levels", levels_,
                                  "Of the chain, the environment itself included (default: down "
                                  "to 16x16 texels; ue4: to 1x1)"),
                 1, kMostLevels)
        ->type_name("N");
    one_of(group.add_option("--mapping", mapping_, "Which roughness each level is for"),
           words(ibl::kRoughnessMappingNames))
        ->capture_default_str();
    std::vector<std::string> methods = words(ibl::kFilterMethodNames);
    methods.emplace_back("progressive");
    one_of(group.add_option("--method", method_,
                            "gather: deterministic, right for a sun too; exact: all texels, slow; "
                            "the others sample"),
           methods)
        ->capture_default_str();
    quality_option_ = one_of(group.add_option("--quality", quality_, "Of gather"),
                             words(ibl::kFilterQualityNames))
                          ->capture_default_str();
    whole_number(group.add_option("--samples", samples_,
                                  "Of the sampling methods: one number, or one per level, the last "
                                  "for all others: 1,8,32,64,128 (default: 32; reference 1024; "
                                  "progressive 512)"),
                 1, kMostSamples)
        ->type_name("N[,N...]")
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    sequence_option_ = one_of(group.add_option("--sequence", sequence_, "Of progressive"),
                              words(ibl::kSampleSequenceNames))
                           ->capture_default_str();
    fis_options_ = {
        positive_number(group.add_option("--fis-overlap", fis_overlap_,
                                         "Of sampling methods but reference: how much footprints "
                                         "of samples overlap"))
            ->type_name("K")
            ->capture_default_str(),
        number(group.add_option("--fis-bias", fis_bias_, "And how many levels blurrier they read"),
               -16, 16)
            ->type_name("LEVELS")
            ->capture_default_str()};
}

void FilterOptions::check(int size) const {
    if (method_ != "gather" && quality_option_->count() > 0) {
        throw InvalidArgument("--quality", quality_, "applies to --method gather");
    }
    if (method_ != "progressive" && sequence_option_->count() > 0) {
        throw InvalidArgument("--sequence", sequence_, "applies to --method progressive");
    }
    if (!samples_are_used() && !samples_.empty()) {
        throw InvalidArgument("--samples", std::to_string(samples_.front()),
                              "applies to methods that sample, and " + method_ + " does not");
    }
    if (method_ == "progressive" && samples_.size() > 1) {
        throw InvalidArgument("--samples", fmt::format("{} numbers", samples_.size()),
                              "progressive takes one");
    }
    for (const CLI::Option* option : fis_options_) {
        if (option->count() > 0 && (!samples_are_used() || method_ == "reference")) {
            throw InvalidArgument(option->get_name(), option->results().front(),
                                  "applies to fis, precomputed, nl-weighted and progressive");
        }
    }
    roughness(size);
}

std::vector<double> FilterOptions::roughness(int size) const {
    const auto mapping = named<ibl::RoughnessMapping>(ibl::kRoughnessMappingNames, mapping_);
    return ibl::level_roughness(mapping, levels_ > 0 ? levels_ : ibl::default_levels(mapping, size),
                                size);
}

ibl::PrefilterOptions FilterOptions::prefilter_options(int size) const {
    ibl::PrefilterOptions options;
    options.roughness = roughness(size);
    options.quality = named<ibl::FilterQuality>(ibl::kFilterQualityNames, quality_);
    options.samples = samples_;
    options.fis_overlap = fis_overlap_;
    options.fis_bias = fis_bias_;
    return options;
}

ibl::CubeChain FilterOptions::filter(const ibl::CubeMap& environment, Session& session) const {
    if (method_ == "progressive") return filter_progressively(environment, session);
    ibl::PrefilterOptions options = prefilter_options(environment.size());
    options.method = named<ibl::FilterMethod>(ibl::kFilterMethodNames, method_);
    ibl::Prefilter prefilter(environment.size(), options);
    ibl::CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain, session);
    return chain;
}

ibl::CubeChain FilterOptions::filter_exactly(const ibl::CubeMap& environment,
                                             Session& session) const {
    ibl::PrefilterOptions options;
    options.roughness = roughness(environment.size());
    options.method = ibl::FilterMethod::kExact;
    ibl::Prefilter prefilter(environment.size(), options);
    ibl::CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain, session);
    return chain;
}

ibl::CubeChain FilterOptions::filter_progressively(const ibl::CubeMap& environment,
                                                   Session& session) const {
    ibl::ProgressiveOptions options;
    options.roughness = roughness(environment.size());
    options.sequence = named<ibl::SampleSequence>(ibl::kSampleSequenceNames, sequence_);
    if (!samples_.empty()) options.samples = samples_.front();
    options.fis_overlap = fis_overlap_;
    options.fis_bias = fis_bias_;
    ibl::ProgressiveFilter filter(environment.size(), options);
    filter.set_environment(environment);
    while (!filter.converged()) {
        filter.advance(kSamplesPerPass);
        session.report("filter", static_cast<double>(filter.samples()) / options.samples);
        session.check_interrupt();
    }
    return filter.result();
}

nlohmann::ordered_json FilterOptions::parameters(int size) const {
    nlohmann::ordered_json json;
    json["levels"] = roughness(size).size();
    json["mapping"] = mapping_;
    json["method"] = method_;
    if (method_ == "gather") json["quality"] = quality_;
    if (samples_are_used()) {
        json["samples"] = samples_;
        if (method_ != "reference") {
            json["fis_overlap"] = fis_overlap_;
            json["fis_bias"] = fis_bias_;
        }
    }
    if (method_ == "progressive") json["sequence"] = sequence_;
    return json;
}

}  // namespace aureole::app
