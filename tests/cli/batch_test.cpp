// SPDX-License-Identifier: MIT
// `conelight batch`: what a job stands for, that each picture is made once and with the same bits however the job
// is cut, stopped and taken up, and what is refused.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class BatchTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        folder = scratchPath("batch_" +
                             std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder);
        fs::create_directories(folder);
        job = folder + "/job.json";
    }

    void write(const std::string& text) const { std::ofstream(job) << text; }
    CommandResult batch(const std::string& more, const std::string& out = "out") const {
        return conelight("batch '" + job + "' -o '" + folder + "/" + out + "' " + more);
    }
    // Every picture, by name.
    std::map<std::string, std::string> pictures(const std::string& out = "out") const {
        std::map<std::string, std::string> found;
        if (!fs::exists(folder + "/" + out)) return found;
        for (const auto& entry : fs::recursive_directory_iterator(folder + "/" + out)) {
            const std::string name = entry.path().lexically_relative(folder + "/" + out).string();
            if (entry.path().extension() == ".exr" || entry.path().extension() == ".png")
                found[name] = bytesOf(entry.path().string());
        }
        return found;
    }
    std::string file(const std::string& name, const std::string& out = "out") const {
        return folder + "/" + out + "/" + name;
    }

    std::string folder, job;
};

constexpr char kSweep[] = R"({
  "conelight": "batch job",
  "scenes": ["builtin:cornell", "builtin:furnace"],
  "options": {"size": "24x16", "mode": "reference", "spp": 2},
  "sweep": {"seed": {"from": 1, "to": 3}},
  "output": "{scene}/{seed}.exr"
})";

TEST_F(BatchTest, ShardsMakeWhatOneProcessMakes) {
    write(kSweep);
    const CommandResult whole = batch("");
    ASSERT_EQ(whole.status, 0) << whole.output;
    const auto wanted = pictures();
    ASSERT_EQ(wanted.size(), 6u);
    EXPECT_NE(wanted.at("cornell/1.exr"), wanted.at("cornell/2.exr"));
    // Each is the picture of the call that the list prints.
    const std::string alone = folder + "/alone.exr";
    ASSERT_EQ(
        conelight("render builtin:cornell --size 24x16 --mode reference --spp 2 --seed 2 -o '" + alone + "'")
            .status,
        0);
    EXPECT_EQ(bytesOf(alone), wanted.at("cornell/2.exr"));

    for (const char* shard : {"3/4", "1/4", "4/4"})
        EXPECT_EQ(batch(std::string("--shard ") + shard, "cut").status, 0);
    EXPECT_EQ(pictures("cut").size(), 4u);
    const CommandResult early = batch("--collect", "cut");
    EXPECT_EQ(early.status, 1);
    EXPECT_NE(early.output.find("batch: 2 of 6 tasks are missing"), std::string::npos) << early.output;
    EXPECT_FALSE(fs::exists(file("manifest.json", "cut")));
    EXPECT_EQ(batch("--shard 2/4 --jobs 2", "cut").status, 0);
    EXPECT_TRUE(pictures("cut") == wanted);
    ASSERT_EQ(batch("--collect", "cut").status, 0);
    EXPECT_EQ(bytesOf(file("manifest.json", "cut")), bytesOf(file("manifest.json")));
    EXPECT_EQ(runCommand("cd '" + folder + "/cut' && sha256sum --check --strict --quiet SHA256SUMS").status,
              0);
}

TEST_F(BatchTest, WhatIsThereIsNotMadeAgain) {
    write(kSweep);
    ASSERT_EQ(batch("").status, 0);
    const auto wanted = pictures();
    EXPECT_NE(batch("").output.find("0 made, 6 were there"), std::string::npos);
    // One that is missing, and one of another length.
    fs::remove(file("cornell/3.exr"));
    std::ofstream(file("furnace/1.exr")) << "short";
    EXPECT_NE(batch("--list").output.find("to do  cornell/3.exr"), std::string::npos);
    const CommandResult again = batch("");
    EXPECT_NE(again.output.find("2 made, 4 were there"), std::string::npos) << again.output;
    EXPECT_TRUE(pictures() == wanted);
    // One byte changed: the sizes fit, the sums do not.
    std::string bytes = wanted.at("cornell/1.exr");
    bytes.back() ^= 1;
    std::ofstream(file("cornell/1.exr"), std::ios::binary) << bytes;
    const CommandResult broken = batch("--collect");
    EXPECT_EQ(broken.status, 1);
    EXPECT_NE(broken.output.find("cornell/1.exr: is not as it was made"), std::string::npos) << broken.output;
    // Another job makes its own anew.
    std::string other = kSweep;
    other.replace(other.find("\"spp\": 2"), 8, "\"spp\": 4");
    write(other);
    EXPECT_NE(batch("").output.find("6 made, 0 were there"), std::string::npos);
    EXPECT_NE(pictures().at("cornell/1.exr"), wanted.at("cornell/1.exr"));
}

TEST_F(BatchTest, ASceneThatChangedIsDrawnAgain) {
    ASSERT_EQ(conelight("convert builtin:cornell '" + folder + "/a.gltf'").status, 0);
    write(R"({"conelight": "batch job", "scenes": ["*.gltf"],
              "options": {"size": "24x16", "mode": "reference", "spp": 2}})");
    ASSERT_EQ(batch("").status, 0);
    const auto before = pictures();
    ASSERT_EQ(before.count("a.exr"), 1u);
    // Its buffer alone.
    ASSERT_EQ(conelight("convert builtin:furnace '" + folder + "/a.gltf' --overwrite").status, 0);
    EXPECT_NE(batch("").output.find("1 made"), std::string::npos);
    EXPECT_NE(pictures().at("a.exr"), before.at("a.exr"));
}

// Stopped in the middle, by a signal that can be caught and by one that cannot: the last task would take hours.
TEST_F(BatchTest, StoppedAndTakenUpItHasTheSameBits) {
    const auto writeJob = [&](const std::string& samples) {
        write(R"({"conelight": "batch job", "scenes": ["builtin:cornell"],
                  "options": {"size": "64x48", "mode": "reference"},
                  "sweep": {"spp": [)" +
              samples + R"(]}, "output": "{spp}.exr"})");
    };
    writeJob("2, 4, 6");
    ASSERT_EQ(batch("", "whole").status, 0);
    const auto whole = pictures("whole");
    ASSERT_EQ(whole.size(), 3u);
    for (const int signal : {SIGTERM, SIGKILL}) {
        const std::string out = signal == SIGTERM ? "term" : "kill";
        const std::string name = folder + "/" + out;
        writeJob("2, 4, 1000000, 6");
        const pid_t child = ::fork();
        if (child == 0) {
            ::execl(CONELIGHT_PROGRAM, "conelight", "batch", job.c_str(), "-o", name.c_str(), nullptr);
            ::_exit(127);
        }
        while (!fs::exists(file("4.exr", out)) && ::waitpid(child, nullptr, WNOHANG) == 0) ::usleep(2000);
        ::kill(child, signal);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);  // it ran until then
        if (signal == SIGTERM) {
            EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
            EXPECT_TRUE(fs::is_empty(file("batch/partial", out)));
        }
        EXPECT_FALSE(fs::exists(file("1000000.exr", out)));
        writeJob("2, 4, 6");
        fs::create_directories(file("batch/partial/of_another", out));
        const CommandResult again = batch("", out);
        EXPECT_NE(again.output.find("1 made, 2 were there, 0 failed"), std::string::npos) << again.output;
        for (const auto& [picture, bytes] : whole)
            EXPECT_TRUE(bytesOf(file(picture, out)) == bytes) << picture;
        EXPECT_FALSE(fs::exists(file("batch/partial/of_another", out)));
    }
}

TEST_F(BatchTest, FramesOfAFilmInPieces) {
    write(
        R"({"conelight": "batch job", "scenes": ["builtin:cornell"], "options": {"size": "24x16", "mode": "phong"},
              "frames": {"turntable": true, "count": 5, "chunk": 2}, "output": "f{frame}.png"})");
    ASSERT_EQ(batch("--shard 2/3").status, 0);
    EXPECT_EQ(pictures().size(), 2u);
    ASSERT_EQ(batch("").status, 0);
    const auto made = pictures();
    ASSERT_EQ(made.size(), 5u);
    const std::string all = folder + "/all%04d.png";
    ASSERT_EQ(
        conelight("render builtin:cornell --size 24x16 --mode phong --turntable --frames 5 -o '" + all + "'")
            .status,
        0);
    for (const auto& [name, bytes] : made)
        EXPECT_TRUE(bytesOf(folder + "/all" + name.substr(1)) == bytes) << name;
}

TEST_F(BatchTest, OneThatFailsStopsNoOther) {
    write(R"({"conelight": "batch job", "scenes": ["builtin:cornell"],
              "options": {"size": "24x16", "mode": "phong"}, "sweep": {"camera": [0, 99]}})");
    const CommandResult result = batch("");
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.output.find("99.exr failed: "), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("batch: 1 of 2 tasks failed"), std::string::npos) << result.output;
    EXPECT_EQ(pictures().size(), 1u);
    EXPECT_NE(bytesOf(file("batch/logs/99.exr.txt")).find("camera"), std::string::npos);
}

TEST_F(BatchTest, NothingIsWrittenOverWhatIsSomebodys) {
    write(kSweep);
    fs::create_directories(file("furnace"));
    std::ofstream(file("furnace/3.exr")) << "mine";
    expectOneLine(batch(""), 2, "furnace/3.exr: is there already");
    EXPECT_EQ(bytesOf(file("furnace/3.exr")), "mine");
    EXPECT_EQ(pictures().size(), 1u);
}

TEST_F(BatchTest, WrongJobsAreOneLine) {
    const auto expect = [&](const std::string& more, const std::string& part) {
        write("{\"conelight\": \"batch job\",\n" + more + "}");
        expectOneLine(batch(""), 3, part);
        EXPECT_FALSE(fs::exists(folder + "/out"));
    };
    const std::string scene = "\"scenes\": [\"builtin:cornell\"],\n";
    expect("\"scene\": 1", "job.json:2: there is no field 'scene'");
    expect("\"scenes\": []", "scenes: a list");
    expect("\"scenes\": [\"nowhere.glb\"]", "no such file");
    expect("\"scenes\": [\"nowhere*.glb\"]", "no file is named like");
    expect(scene + "\"options\": {\"voxel\": 3}", "job.json:3: there is no option 'voxel'");
    expect(scene + "\"options\": {\"output\": \"a.exr\"}", "there is no option 'output'");
    expect(scene + "\"options\": {\"mode\": [1]}", "is no value");
    expect(scene + "\"sweep\": {\"seed\": {\"from\": 3, \"to\": 1}}", "from below to");
    expect(scene + "\"sweep\": {\"seed\": []}", "a list of values");
    expect(scene + "\"sweep\": {\"seed\": {\"from\": 1, \"to\": 999999999}}", "from below to");
    expect(scene + "\"options\": {\"seed\": 1}, \"sweep\": {\"seed\": [1]}", "stands in options, too");
    expect(scene + "\"sweep\": {\"seed\": [1, 2]}, \"output\": \"a.exr\"",
           "several pictures would be named a.exr");
    expect(scene + "\"output\": \"../a.exr\"", "below the folder of results");
    expect(scene + "\"output\": \"batch/a.exr\"", "outside of its folder batch");
    expect(scene + "\"output\": \"a.tiff\"", ".png .jpg .jpeg .exr .hdr");
    expect(scene + "\"output\": \"{mood}.exr\"", "{mood}: neither scene");
    expect(scene + "\"output\": \"{frame}.exr\"", "there are no frames");
    expect(scene + "\"frames\": {\"count\": 3}", "one of \"path\"");
    expect(scene + "\"frames\": {\"turntable\": true}", "count: how many");
    expect(scene + "\"frames\": {\"turntable\": true, \"count\": 3}, \"output\": \"a.png\"",
           "{frame} in the name");
    expect("\"scenes\": [\"job.json\"], \"sweep\": {\"scene.seed\": [1]}", "takes no parameters");
    write("[1]");
    expectOneLine(batch(""), 3, "is no batch job");
    write(kSweep);
    for (const char* shard : {"0/3", "4/3", "x", "1", "1/2/3"})
        expectOneLine(batch(std::string("--shard ") + shard), 2, "--shard");
}

TEST_F(BatchTest, TheScriptForSlurmNamesItsShards) {
    write(kSweep);
    const CommandResult script = batch("--slurm 3 --jobs 2");
    ASSERT_EQ(script.status, 0) << script.output;
    EXPECT_EQ(script.output.rfind("#!/bin/sh\n#SBATCH --job-name=job\n#SBATCH --array=1-3\n", 0), 0u);
    std::ofstream(folder + "/shard.sh") << script.output;
    // As Slurm would call it.
    for (int shard = 1; shard <= 3; ++shard)
        EXPECT_EQ(runCommand("SLURM_ARRAY_TASK_ID=" + std::to_string(shard) + " sh '" + folder + "/shard.sh'")
                      .status,
                  0);
    EXPECT_EQ(pictures().size(), 6u);
    EXPECT_EQ(batch("--collect").status, 0);
}

}  // namespace
}  // namespace conelight::test
