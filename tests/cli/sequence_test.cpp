// Several pictures and numbered sequences, also those that end early.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

class Sequence : public CliTest {
  protected:
    void SetUp() override { write("k.exr", soft_kernel(9)); }
    static std::string numbered(const std::string& before, int frame, const std::string& after) {
        std::string number = std::to_string(frame);
        number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
        return before + number + after;
    }
    void write_frames(int first, int last) const {
        for (int frame = first; frame <= last; ++frame) {
            write(numbered("shot.", frame, ".exr"), noise(16, 12, 3, static_cast<unsigned>(frame)));
        }
    }
    // The file is what a run on this frame alone gives.
    void expect_frame(int frame, const std::string& name) const {
        const Outcome outcome =
            run("glare " + numbered("shot.", frame, ".exr") + " -o alone.exr --psf k.exr");
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(identical(read(name).image(), read("alone.exr").image())) << name;
        std::filesystem::remove(file("alone.exr"));
    }
    bool appears(Program& program, const std::string& name) const {
        while (program.running() && !exists(name)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return exists(name);
    }
};

TEST_F(Sequence, NumbersOfInputAndOutputAgree) {
    write_frames(9, 11);
    for (const char* words :
         {"glare shot.%04d.exr -o out.%d.exr -o out.####.png --psf k.exr --frames 9-11",
          "glare shot.####.exr -o out.%d.exr -o out.%04d.png --psf k.exr --frames 9-11"}) {
        const Outcome outcome = run(words);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        for (int frame = 9; frame <= 11; ++frame) {
            const std::string exr = "out." + std::to_string(frame) + ".exr";
            expect_frame(frame, exr);
            EXPECT_TRUE(exists(numbered("out.", frame, ".png")));
            EXPECT_TRUE(names_all(outcome.out, {exr}));
            std::filesystem::remove(file(exr));
            std::filesystem::remove(file(numbered("out.", frame, ".png")));
        }
        EXPECT_EQ(folder_.names().size(), 4U);  // three frames and the kernel
    }
}

TEST_F(Sequence, StepsAndListsOfFrames) {
    write_frames(1, 7);
    ASSERT_EQ(run("glare shot.####.exr -o out.####.exr --psf k.exr --frames 1-5x2,7").exit_code, 0);
    for (int frame = 1; frame <= 7; ++frame) {
        EXPECT_EQ(exists(numbered("out.", frame, ".exr")), frame % 2 == 1) << frame;
    }
}

TEST_F(Sequence, IntoAFolder) {
    write_frames(1, 2);
    std::filesystem::create_directory(file("dir"));
    ASSERT_EQ(run("glare shot.####.exr -o dir --psf k.exr --frames 1-2").exit_code, 0);
    expect_frame(1, "dir/shot.0001.exr");
    expect_frame(2, "dir/shot.0002.exr");
}

TEST_F(Sequence, SideBySideIsNumberedToo) {
    write_frames(1, 2);
    const std::string command = "glare shot.####.exr -o out.####.exr --psf k.exr --frames 1-2 ";
    ASSERT_EQ(run(command + "--side-by-side both.####.png").exit_code, 0);
    EXPECT_TRUE(exists("both.0001.png"));
    EXPECT_TRUE(exists("both.0002.png"));
    EXPECT_EQ(run(command + "--side-by-side both.png").exit_code, 2);
}

TEST_F(Sequence, MissingFrameInTheMiddleKeepsThoseBefore) {
    write_frames(1, 4);
    std::filesystem::remove(file("shot.0003.exr"));
    const Outcome outcome = run("glare shot.%04d.exr -o out.%04d.exr --psf k.exr --frames 1-4");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"shot.0003.exr"}));
    expect_frame(1, "out.0001.exr");
    expect_frame(2, "out.0002.exr");
    EXPECT_FALSE(exists("out.0003.exr"));
    EXPECT_FALSE(exists("out.0004.exr"));
}

TEST_F(Sequence, EnergyAndBadPixelsAreSummed) {
    write("shot.1.exr", constant(16, 12, 3, 1));
    Image second = constant(16, 12, 3, 2);
    second.at(0, 0) /= 0.0F;
    write("shot.2.exr", second);
    const auto json = report(
        "glare shot.%d.exr -o out.%d.exr --psf k.exr --frames 1-2 "
        "--perspective off");
    EXPECT_NEAR(json["energy"]["in"].get<double>(), 3.0 * 16 * 12 * 3 - 2, 1e-6);
    EXPECT_EQ(json["nonfinite_pixels"], 1);
    EXPECT_EQ(json["outputs"].size(), 2U);
}

// An eye does not change from frame to frame because a light comes into view.
TEST_F(Sequence, KeepsTheEyeOfItsFirstFrame) {
    write("shot.1.exr", constant(16, 12, 3, 0.01F));
    write("shot.2.exr", constant(16, 12, 3, 10));
    const auto both =
        report("glare shot.%d.exr -o out.%d.exr --frames 1-2" + kPlainEye)["parameters"];
    const auto first = report("glare shot.1.exr -o first.exr" + kPlainEye)["parameters"];
    EXPECT_EQ(both["pupil_mm"], first["pupil_mm"]);
    const std::string pupil = both["pupil_mm"].dump();
    ASSERT_EQ(run("glare shot.2.exr -o second.exr" + kPlainEye + "--pupil " + pupil).exit_code, 0);
    EXPECT_TRUE(identical(read("out.2.exr").image(), read("second.exr").image()));
}

// Without --frames, pictures have nothing to do with each other.
TEST_F(Sequence, SeveralPicturesAreIndependent) {
    std::filesystem::create_directory(file("dir"));
    write("a.exr", constant(16, 12, 3, 0.01F));
    write("b.exr", constant(16, 12, 3, 10));
    write("c.exr", noise(8, 20, 1), {"Y"});
    ASSERT_EQ(run("glare a.exr b.exr c.exr -o dir" + kPlainEye).exit_code, 0);
    for (const std::string& name :
         {std::string("a.exr"), std::string("b.exr"), std::string("c.exr")}) {
        ASSERT_EQ(run("glare " + name + " -o alone.exr" + kPlainEye).exit_code, 0);
        EXPECT_TRUE(identical(read("dir/" + name).image(), read("alone.exr").image())) << name;
    }
}

TEST_F(Sequence, ColourAndGreyOfOneSizeMayBeMixed) {
    std::filesystem::create_directory(file("dir"));
    write("a.exr", noise(16, 12, 3));
    write("b.exr", noise(16, 12, 1), {"Y"});
    ASSERT_EQ(run("glare b.exr a.exr -o dir --psf k.exr").exit_code, 0);
    ASSERT_EQ(run("glare a.exr -o alone.exr --psf k.exr").exit_code, 0);
    EXPECT_TRUE(identical(read("dir/a.exr").image(), read("alone.exr").image()));
}

TEST_F(Sequence, SeveralPicturesOfOneNameAreRefused) {
    std::filesystem::create_directory(file("x"));
    std::filesystem::create_directory(file("dir"));
    write("a.exr", noise(8, 6, 3));
    write("x/a.exr", noise(8, 6, 3));
    const Outcome outcome = run("glare a.exr x/a.exr -o dir --psf k.exr");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(names_all(outcome.err, {"a.exr", "more than once"}));
    EXPECT_TRUE(std::filesystem::is_empty(file("dir")));
}

// A name with % or # is a pattern only where frames were asked for.
TEST_F(Sequence, SinglePicturesMayHaveAnyName) {
    write("50%-#2.exr", noise(16, 12, 3));
    write("a%04d.exr", noise(16, 12, 3));
    EXPECT_EQ(run("glare 50%-#2.exr -o 100%.exr --psf k.exr").exit_code, 0);
    EXPECT_EQ(run("glare a%04d.exr -o b####.exr --psf k.exr").exit_code, 0);
    EXPECT_TRUE(exists("100%.exr"));
    EXPECT_TRUE(exists("b####.exr"));
    const Outcome missing = run("glare 60%.exr -o out.exr --psf k.exr");
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_TRUE(names_all(missing.err, {"60%.exr", "no such file"}));
}

// The same note for every frame would bury the others.
TEST_F(Sequence, NotesAreSaidOnce) {
    write_frames(1, 3);
    const Outcome outcome = run("glare shot.####.exr -o out.####.exr --psf k.exr --frames 1-3");
    ASSERT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err.find("field of view"), outcome.err.rfind("field of view"));
    EXPECT_NE(outcome.err.find("field of view"), std::string::npos);
}

TEST_F(Sequence, InterruptKeepsTheFramesThatAreWritten) {
    constexpr int kFrames = 5000;  // far more than are done before the interrupt
    const Image frame = noise(16, 12, 3);
    write("shot.exr", frame);
    for (int i = 1; i <= kFrames; ++i) {
        std::filesystem::create_symlink("shot.exr", file(numbered("shot.", i, ".exr")));
    }
    std::filesystem::create_directory(file("dir"));
    for (const int number : {SIGINT, SIGTERM}) {
        Program program(folder_.path(),
                        "glare shot.%04d.exr -o dir/out.%04d.exr --psf k.exr --frames 1-5000");
        ASSERT_TRUE(appears(program, "dir/out.0003.exr"));
        program.signal(number);
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(names_all(outcome.err, {"interrupted"}));
        ASSERT_EQ(run("glare shot.exr -o alone.exr --psf k.exr").exit_code, 0);
        const Image expected = read("alone.exr").image();
        int written = 0;
        for (const auto& entry : std::filesystem::directory_iterator(file("dir"))) {
            const std::string name = entry.path().filename().string();
            EXPECT_EQ(name.rfind("out.", 0), 0U) << name;  // no temporary file
            EXPECT_TRUE(identical(read("dir/" + name).image(), expected)) << name;
            ++written;
        }
        EXPECT_GE(written, 3);
        EXPECT_LT(written, kFrames);
        for (int i = 1; i <= written; ++i)
            std::filesystem::remove(file(numbered("dir/out.", i, ".exr")));
        EXPECT_TRUE(std::filesystem::is_empty(file("dir")));  // the frames were written in order
    }
}

// Before anything is written, nothing is: the note comes before the eye is computed.
TEST_F(Sequence, InterruptOfASinglePictureLeavesNothing) {
    write("in.exr", noise(64, 36, 3));
    Program program(folder_.path(), "glare in.exr -o out.exr");
    while (program.running() && program.err().find("field of view") == std::string::npos) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    program.signal(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(names_all(outcome.err, {"interrupted"}));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"in.exr", "k.exr"}));
}

}  // namespace
}  // namespace aureole::cli
