// What is said of an eye that cannot move as it is told to, of options without an effect, and of
// tables.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.h"

namespace aureole::cli {
namespace {

const std::string kGlare = "glare in.0000.exr -o out.exr --fov 40 ";

class MotionErrors : public CliTest {
  protected:
    void SetUp() override {
        for (const char* name : {"in.0000.exr", "in.0001.exr"}) write(name, constant(24, 16, 3, 1));
    }
    void fails(const std::string& words, int code, const std::vector<std::string>& named) const {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, code) << words;
        EXPECT_TRUE(names_all(outcome.err, named)) << words << "\n" << outcome.err;
        EXPECT_FALSE(exists("out.exr")) << words;
    }
};

TEST_F(MotionErrors, SayWhatIsMissingOrWrong) {
    fails(kGlare + "--blink auto", 2, {"--blink", "--time"});
    fails(kGlare + "--adaptation a.csv", 2, {"a.csv", "--time"});
    fails(kGlare + "--adaptation a.csv --time 1", 1, {"a.csv"});
    fails("glare in.%04d.exr --frames 0-1 -o out.%04d.exr --fps 24", 2,
          {"--fps", "--adaptation", "meter"});
    fails(kGlare + "--time 1 --squint 2", 2, {"--squint", "0.8"});
    fails(kGlare + "--time 1 --fps 0", 2, {"--fps", "above 0"});
    fails(kGlare + "--time 1 --observer camera", 2, {"--time", "--observer"});
    fails(kGlare + "--time 1 --blink 3,1", 2, {"--blink", "3,1", "later"});
    write_bytes("bad.csv", "time_s,adaptation_cd_m2\n0,1\n1,bright\n");
    fails(kGlare + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "line 3", "bright", "number"});
    write_bytes("bad.csv", "time_s,luminance\n0,1\n");
    fails(kGlare + "--time 1 --adaptation bad.csv", 1,
          {"bad.csv", "adaptation_cd_m2", "luminance"});
    write_bytes("bad.csv", "time_s,adaptation_cd_m2\n0,1\n0,1\n");
    fails(kGlare + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "later"});
    write_bytes("bad.csv", "");
    fails(kGlare + "--time 1 --adaptation bad.csv", 1, {"bad.csv", "no numbers"});
    const std::string psf = "psf -o out.exr --size 9 ";
    fails(psf + "--blink auto", 2, {"--blink", "--time"});
    fails(psf + "--adaptation a.csv", 2, {"a.csv", "--time"});
    fails(psf + "--time 1 --fps 24", 2, {"--fps"});
    fails(psf + "--time 1 --observer camera", 2, {"--time", "--observer"});
    fails("meter in.%04d.exr -o a.csv", 2, {"--frames"});
    fails("meter missing.exr -o a.csv", 1, {"missing.exr"});
}

TEST_F(MotionErrors, NameTheOptionAndItsWords) {
    fails(kGlare + "--time 1 --blink atuo", 1, {"atuo", "--blink", "off, auto, streaks", "CSV"});
    fails(kGlare + "--time 1 --motion sacades", 1, {"sacades", "--motion", "off, saccades"});
    fails(kGlare + "--time 1 --adaptation atuo", 1, {"atuo", "--adaptation", "auto", "cd/m2"});
    write_bytes("b.csv", "time_s\n3\n2\n");
    fails(kGlare + "--time 1 --blink b.csv", 1, {"b.csv", "2", "later"});
    fails(kGlare + "--time 1e30", 2, {"--time", "1e30", "1e+09"});
    fails(kGlare + "--time 1 --adaptation 1e308", 2, {"--adaptation", "1e308", "1e+12"});
    fails(kGlare + "--adaptation -1", 2, {"--adaptation", "-1"});
    fails("psf -o out.exr --size 9 --time 1e30 --pupil 4", 2, {"--time", "1e30"});
    fails("glare in.%04d.exr --frames 0-1 -o out.%04d.exr --pupil 4 --fps 1e-300", 2,
          {"--fps", "1e-300", "frame 1"});
}

TEST_F(MotionErrors, RefuseWhatHasNoEffect) {
    fails(kGlare + "--pupil 4 --pupil-model de-groot", 2, {"--pupil-model", "--pupil 4"});
    fails(kGlare + "--pupil 4 --adaptation 5", 2, {"--adaptation", "--pupil 4"});
    fails(kGlare + "--pupil 4 --adaptation 5 --time 1 --squint 0", 2, {"--adaptation", "--pupil"});
    fails(kGlare + "--preset thesis --pupil 4 --adaptation 5", 2, {"--adaptation", "--pupil 4"});
    fails(kGlare + "--time 1 --eyelashes 0 --blink streaks", 2, {"--eyelashes 0", "--blink"});
    fails(kGlare + "--time 1 --streaks 0 --blink streaks", 2, {"--streaks 0", "--blink"});
    const std::string frames = "glare in.%04d.exr --frames 0-1 -o out.%04d.exr --fov 40 ";
    fails(frames + "--time 1", 2, {"--time", "--frames", "--fps"});
    fails(frames + "--time 1 --preset thesis", 2, {"--time", "--frames", "--fps"});
    fails(frames + "--fps 24 --pupil 4 --squint .3", 2, {"--squint", "--fps", "--adaptation"});
    fails("psf -o out.exr --size 9 --time 1 --pupil 4 --squint .3", 2, {"--squint", "luminance"});
    fails(kGlare + "--preset thesis --motion saccades", 2, {"--motion", "leave it out"});
    fails(kGlare + "--preset thesis --squint .5", 2, {"--squint", "--eyelid"});
}

TEST_F(MotionErrors, NoteWhatIsBeyondATableOrABook) {
    const auto notes = [&](const std::string& words, const std::vector<std::string>& named) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(names_all(outcome.err, named)) << outcome.err;
        return outcome.err;
    };
    write_bytes("a.csv", "time_s,adaptation_cd_m2\n0,10\n.5,100\n");
    write_bytes("h.csv", "time_s,yaw_deg,pitch_deg,roll_deg\n2,0,0,0\n3,9,0,0\n");
    const std::string eye = kGlare + kPlainEye;
    notes(eye + "--adaptation a.csv --time 100", {"a.csv", "ends at 0.5 s"});
    notes(eye + "--adaptation a.csv --time -1", {"a.csv", "begins at 0 s"});
    notes(eye + "--adaptation 10 --motion h.csv --time 1", {"h.csv", "begins at 2 s"});
    EXPECT_EQ(notes(eye + "--adaptation a.csv --time .5", {}), "");
    notes(kGlare + "--preset thesis --pupil 9", {"--preset thesis", "1.9 to 7.9 mm"});
}

// As spreadsheets write them.
TEST_F(MotionErrors, TablesComeFromAnywhere) {
    const std::string common = kGlare + kPlainEye + "--time .25 --adaptation a.csv";
    write_bytes("a.csv", "time_s,adaptation_cd_m2\n0,10\n.5,1000\n");
    const double expected = report(common)["parameters"]["pupil_mm"];
    for (const std::string text :
         {"\xEF\xBB\xBFtime_s,adaptation_cd_m2\r\n0,10\r\n.5,1000\r\n",
          "\xEF\xBB\xBF\"time_s\";\"adaptation_cd_m2\"\n0;10\n\".5\";\"1000\"\n",
          "note\ttime_s\tadaptation_cd_m2\n1\t0\t10\n2\t.5\t1000\n",
          "\"time, s\",time_s,\"adaptation_cd_m2\"\n1,0,10\n2,.5,1000\n"}) {
        write_bytes("a.csv", text);
        EXPECT_EQ(report(common)["parameters"]["pupil_mm"], expected) << text;
    }
    ASSERT_EQ(std::remove(file("out.exr").c_str()), 0);
    write_bytes("a.csv", "time_s;adaptation_cd_m2\n0;10\n0,5;1000\n");
    fails(common, 1, {"a.csv", "line 3", "0,5", "0.5"});
    write_bytes("a.csv", "\"time_s,adaptation_cd_m2\n0,10\n");
    fails(common, 1, {"a.csv", "line 1", "quote"});
    write_bytes("a.csv", "time_s,luminosit\xE9\n0,10\n");
    fails(common, 1, {"a.csv", "adaptation_cd_m2", "luminosit?"});
}

TEST_F(MotionErrors, APictureIsNoTable) {
    for (const std::string option : {"--adaptation", "--motion", "--blink"}) {
        const Outcome outcome = run(kGlare + "--time 1 " + option + " in.0001.exr");
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(names_all(outcome.err, {"in.0001.exr", "is no table (CSV)"})) << outcome.err;
        for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || (c >= ' ' && c < '\x7F'));
    }
}

}  // namespace
}  // namespace aureole::cli
