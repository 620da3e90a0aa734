// SPDX-License-Identifier: MIT
// The main function of every test program. The guests that the program brings along are there for tests, too;
// which shaders they asked for is checked at the end. Beside what gtest prints, it writes one line per test
// into the file CONELIGHT_TEST_RESULTS: `passed`, `failed` or `skipped`, the CPU milliseconds of the test and
// its children, its name. A line `running` that no other follows names a test that ended its process. Exit
// status: gtest's, but 77 where every test was skipped.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "conelight/guests.h"
#include "support/variant_check.h"

namespace conelight::test {
namespace {

constexpr int kAllSkipped = 77;  // SKIP_RETURN_CODE in tests/test_groups.cmake

double cpuMs() {
    double sum = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(who, &used);
        for (const timeval& t : {used.ru_utime, used.ru_stime})
            sum += 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
    }
    return sum;
}

class ResultLines : public ::testing::EmptyTestEventListener {
  public:
    explicit ResultLines(const char* path) : file_(std::fopen(path, "w")) {}
    ~ResultLines() override {
        if (file_ != nullptr) std::fclose(file_);
    }

  private:
    void OnTestStart(const ::testing::TestInfo& test) override {
        began_ = cpuMs();
        line("running", test);
    }
    void OnTestEnd(const ::testing::TestInfo& test) override {
        const ::testing::TestResult& result = *test.result();
        line(result.Failed() ? "failed" : result.Skipped() ? "skipped" : "passed", test);
    }
    void line(const char* word, const ::testing::TestInfo& test) {
        if (file_ == nullptr) return;
        std::fprintf(file_, "%s %.0f %s.%s\n", word, cpuMs() - began_, test.test_suite_name(), test.name());
        std::fflush(file_);
    }

    std::FILE* file_;
    double began_ = 0;
};

}  // namespace
}  // namespace conelight::test

int main(int argc, char** argv) {
    conelight::program::registerGuests();
    ::testing::InitGoogleTest(&argc, argv);
    conelight::test::checkVariantsAtTheEnd();
    const ::testing::UnitTest& tests = *::testing::UnitTest::GetInstance();
    if (const char* path = std::getenv("CONELIGHT_TEST_RESULTS"); path != nullptr) {
        ::testing::UnitTest::GetInstance()->listeners().Append(new conelight::test::ResultLines(path));
        unsetenv("CONELIGHT_TEST_RESULTS");  // children that run this program write none
    }
    const int status = RUN_ALL_TESTS();
    const bool allSkipped = tests.skipped_test_count() > 0 && tests.successful_test_count() == 0;
    return status == 0 && allSkipped ? conelight::test::kAllSkipped : status;
}
