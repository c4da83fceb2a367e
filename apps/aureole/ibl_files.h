// The files of `aureole ibl`: --format, --texel, --arrange, and how a set of them is written.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "aureole/ibl/brdf_table.h"
#include "aureole/ibl/cube_map.h"
#include "aureole/io/file_set.h"
#include "aureole/io/texture.h"
#include "session.h"

namespace aureole::app {

struct IblFileOptions {
    void add_options(CLI::App& command);
    // Throws InvalidArgument for options that have no effect in this format.
    void check() const;
    nlohmann::ordered_json parameters() const;

    bool is_texture() const { return format == "dds" || format == "ktx2"; }

    CLI::Option* texel_option = nullptr;
    CLI::Option* arrange_option = nullptr;
    std::string format = "dds";
    std::string texel = "half";
    std::string arrange = "strip";
};

// All files appear together in one folder, or none does.
class IblFiles {
  public:
    // Throws FileError if nothing can be written there.
    IblFiles(const std::string& folder, const IblFileOptions& options, Session& session);

    // environment.dds with all levels, or level_0.exr, level_1.exr...
    void write_environment(const ibl::CubeChain& chain);
    void write_irradiance(const ibl::CubeMap& irradiance);
    void write_table(const ibl::BrdfTable& table);
    void write_json(const std::string& name, const nlohmann::ordered_json& json);
    // After the last one; the paths of all files.
    std::vector<std::string> commit();

  private:
    void write_texture(const std::string& name, const io::Texture& texture);
    void write_cube(const std::string& name, const ibl::CubeMap& cube);
    void write_picture(const std::string& name, Image image);
    std::string path(const std::string& name);

    std::string folder_;
    const IblFileOptions& options_;
    Session& session_;
    io::FileSet set_;
    std::vector<std::string> names_;
};

}  // namespace aureole::app
