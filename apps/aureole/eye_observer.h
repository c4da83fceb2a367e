// Eyes, and kernels in files, as observers.
#pragma once

#include <optional>
#include <string>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/field_psf.h"
#include "aureole/wave/varying_psf.h"
#include "eye_options.h"
#include "field_varying_option.h"
#include "observer.h"
#include "session.h"
#include "spread_options.h"
#include "view_options.h"

namespace aureole::app {

// Which pictures the eye adapts to if the options do not say.
enum class Metering {
    kEachPicture,  // pictures that have nothing to do with each other
    kFirst,        // a sequence keeps the eye of its first picture
};

// The luminance that a picture is metered at: its attribute aureole:adaptation_cd_m2, else its
// mean; eye::kBrightestCdM2 at most.
double metered_cd_m2(const io::Picture& picture, double white_luminance_cd_m2);

// The PSFs of an eye for pictures whose data window is seen as `data`.
Spreading spreading_of(const eye::Eye& eye, Passes passes, const View& data,
                       const eye::SpectralSampling& sampling, Session& session);

class EyeObserver : public Observer {
  public:
    EyeObserver(const EyeOptions& eye, const ViewOptions& view, Metering metering, Passes passes,
                const FieldVaryingOption& field, Session& session)
        : options_(eye),
          view_(view),
          metering_(metering),
          passes_(passes),
          field_(field),
          session_(session) {}

    View view_of(const io::Picture& picture) override { return view_.view_of(picture, session_); }
    bool adapt(const io::Picture& picture) override;
    Spreading spreading(const View& display, const View& data) override;
    std::optional<wave::VaryingPsf> varying_psf(const View& display, const View& data) override;
    void report(nlohmann::ordered_json& json) const override;

  private:
    void measure_field(const wave::VaryingPsf& psf, const eye::FieldPsfOptions& options);
    double adaptation_to(const io::Picture& picture) const;

    const EyeOptions& options_;
    const ViewOptions& view_;
    Metering metering_;
    Passes passes_;
    const FieldVaryingOption& field_;
    Session& session_;
    std::optional<double> metered_cd_m2_;
    double white_luminance_cd_m2_ = 0;
    eye::Eye eye_;
    nlohmann::ordered_json field_report_;
};

class KernelObserver : public Observer {
  public:
    KernelObserver(std::string file, const ViewOptions& view, Session& session)
        : file_(std::move(file)), view_(view), session_(session) {}

    View view_of(const io::Picture& picture) override;
    Spreading spreading(const View& display, const View& data) override;
    void report(nlohmann::ordered_json& json) const override;

  private:
    std::string file_;
    const ViewOptions& view_;
    Session& session_;
    double white_luminance_cd_m2_ = 0;
};

}  // namespace aureole::app
