// Files that are missing, broken or cannot be written: exit code 1, a message that names the file,
// and nothing left behind.
#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

class BadInput : public CliTest, public testing::WithParamInterface<std::string> {
  protected:
    // A file or folder of the name "bad...", as the parameter says.
    std::string make() const {
        const std::string& kind = GetParam();
        if (kind == "folder") {
            std::filesystem::create_directory(file("bad"));
            return "bad";
        }
        if (kind == "no_pixels") {
            write_bytes("bad.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n");
            return "bad.hdr";
        }
        if (kind == "text") write_bytes("bad.exr", "This is no picture.\n");
        if (kind == "empty") write_bytes("bad.exr", "");
        if (kind == "truncated" || kind == "header_only") {
            write("whole.exr", noise(64, 48, 3));
            const std::string whole = bytes("whole.exr");
            std::filesystem::remove(file("whole.exr"));
            write_bytes("bad.exr", whole.substr(0, kind == "truncated" ? whole.size() / 2 : 200));
        }
        return "bad.exr";
    }
};

TEST_P(BadInput, IsNamedAndLeavesNothing) {
    const std::string bad = make();
    write("in.exr", noise(8, 6, 3));
    write("k.exr", soft_kernel(5));
    const std::vector<std::string> before = folder_.names();
    for (const std::string& words :
         {"glare " + bad + " -o out.exr --psf k.exr", "glare in.exr -o out.exr --psf " + bad,
          "glare in.exr -o out.exr --psf k.exr --matte " + bad}) {
        const Outcome outcome = run(words + " --json");
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_EQ(outcome.out, "") << words;  // no half report
        EXPECT_TRUE(names_all(outcome.err, {bad})) << words;
        EXPECT_EQ(folder_.names(), before) << words;
    }
}

INSTANTIATE_TEST_SUITE_P(Kind, BadInput,
                         testing::Values("missing", "folder", "text", "empty", "no_pixels",
                                         "truncated", "header_only"),
                         [](const auto& test_case) { return test_case.param; });

class BadOutput : public CliTest {
  protected:
    void SetUp() override {
        write("in.exr", noise(64, 48, 3));
        write("k.exr", soft_kernel(5));
    }
    // Expects failure with a message that names `path`, no output and no new file.
    void expect_failure(const std::string& words, const std::string& path,
                        const Conditions& conditions = {}) const {
        const std::vector<std::string> before = folder_.names();
        const Outcome outcome = run(words, conditions);
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_EQ(outcome.out, "") << words;
        EXPECT_TRUE(names_all(outcome.err, {path, "cannot be written"})) << words;
        EXPECT_EQ(folder_.names(), before) << words;
    }
};

TEST_F(BadOutput, FolderThatIsMissing) {
    expect_failure("glare in.exr -o no/out.exr --psf k.exr", "no/out.exr");
    expect_failure("psf --pupil 4 --size 9 -o no/out.exr", "no/out.exr");
    expect_failure("scene point --width 8 --height 8 -o no/out.exr", "no/out.exr");
    expect_failure("glare in.exr -o a.exr --side-by-side no/b.png --psf k.exr", "no/b.png");
}

TEST_F(BadOutput, FolderThatIsAFile) {
    expect_failure("glare in.exr -o k.exr/out.exr --psf k.exr", "k.exr/out.exr");
}

// Where not even root may make files.
TEST_F(BadOutput, FolderThatTakesNoFiles) {
    expect_failure("glare in.exr -o /proc/out.exr --psf k.exr", "/proc/out.exr");
}

TEST_F(BadOutput, FullDiskLeavesNoPartialFile) {
    Conditions full;
    full.largest_file = 4096;
    for (const char* name : {"out.exr", "out.hdr", "out.tif", "out.png", "out.jpg"}) {
        full.largest_file =
            std::string(name) == "out.png" || std::string(name) == "out.jpg" ? 512 : 4096;
        expect_failure(std::string("glare in.exr --psf k.exr -o ") + name, name, full);
    }
    full.largest_file = 4096;
    expect_failure("scene bars --width 64 --height 64 -o out.exr", "out.exr", full);
    expect_failure("psf --pupil 4 --size 65 -o out.exr", "out.exr", full);
}

TEST_F(BadOutput, FailureLeavesWhatWasThere) {
    write_bytes("out.exr", "the result of yesterday");
    Conditions full;
    full.largest_file = 4096;
    expect_failure("glare in.exr -o out.exr --psf k.exr", "out.exr", full);
    EXPECT_EQ(bytes("out.exr"), "the result of yesterday");
    EXPECT_EQ(run("glare missing.exr -o out.exr --psf k.exr").exit_code, 1);
    EXPECT_EQ(run("glare in.exr -o out.exr --psf missing.exr").exit_code, 1);
    EXPECT_EQ(run("glare in.exr -o out.exr --fov 0").exit_code, 2);
    EXPECT_EQ(bytes("out.exr"), "the result of yesterday");
    EXPECT_EQ(run("glare in.exr -o out.exr --psf k.exr").exit_code, 0);
    EXPECT_EQ(read("out.exr").image().width(), 64);
}

// The report is the result of a run with --json: losing it is a failure.
TEST_F(BadOutput, ReportThatCannotBeWritten) {
    Conditions conditions;
    conditions.standard_output = "/dev/full";
    const Outcome outcome = run("glare in.exr -o out.exr --psf k.exr --json", conditions);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"standard output"}));
    EXPECT_EQ(read("out.exr").image().width(), 64);
}

// A wrong output is found before the work: an eye is not computed first.
TEST_F(BadOutput, IsFoundBeforeTheWork) {
    const Outcome outcome = run("glare missing.exr -o no/out.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"no/out.exr"}));
}

}  // namespace
}  // namespace aureole::cli
