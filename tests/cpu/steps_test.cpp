// SPDX-License-Identifier: MIT
// Work in steps: order, nesting, failures, and work that is left.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "base/steps.h"

namespace conelight {
namespace {

struct Log {
    std::string text;
};

// Says when it is gone.
struct Local {
    Log& log;
    ~Local() { log.text += "~"; }
};

base::Steps inner(Log& log, const std::string& name, int count) {
    const Local local{log};
    for (int i = 0; i < count; ++i) {
        log.text += name + std::to_string(i) + " ";
        co_await std::suspend_always{};
    }
}

base::Steps failing(Log& log) {
    co_await inner(log, "f", 1);
    throw std::runtime_error("broken");
}

base::Steps outer(Log& log) {
    log.text += "( ";
    co_await inner(log, "a", 2);
    co_await inner(log, "none", 0);
    co_await base::Steps();
    co_await inner(log, "b", 1);
    log.text += ") ";
}

base::Steps mending(Log& log) {
    bool failed = false;
    try {
        co_await failing(log);
    } catch (const std::runtime_error& error) {
        log.text += error.what();
        failed = true;
    }
    if (failed) co_await inner(log, " m", 1);
}

TEST(Steps, GoOnWhereTheyRested) {
    Log log;
    base::Steps steps = outer(log);
    EXPECT_EQ(log.text, "") << "nothing runs before the first step";
    steps.step();
    EXPECT_EQ(log.text, "( a0 ");
    steps.step();
    EXPECT_EQ(log.text, "( a0 a1 ");
    base::Steps moved = std::move(steps);
    EXPECT_TRUE(steps.done());
    moved.step();
    EXPECT_EQ(log.text, "( a0 a1 ~~b0 ");
    EXPECT_FALSE(moved.done());
    moved.step();
    EXPECT_EQ(log.text, "( a0 a1 ~~b0 ~) ");
    EXPECT_TRUE(moved.done());
    moved.step();
    Log whole;
    outer(whole).finish();
    EXPECT_EQ(whole.text, log.text);
}

TEST(Steps, ThrowWhatTheWorkThrows) {
    Log log;
    base::Steps steps = failing(log);
    steps.step();
    EXPECT_THROW(steps.step(), std::runtime_error);
    EXPECT_TRUE(steps.done());
    Log mended;
    mending(mended).finish();
    EXPECT_EQ(mended.text, "f0 ~broken m0 ~");
}

TEST(Steps, LeftWorkGoesNoFurther) {
    Log log;
    {
        base::Steps steps = outer(log);
        steps.step();
    }
    EXPECT_EQ(log.text, "( a0 ~");
    base::Steps never = outer(log);
    never = {};
    EXPECT_EQ(log.text, "( a0 ~");
}

}  // namespace
}  // namespace conelight
