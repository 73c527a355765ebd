// A fingerprint says in what two frames differ.
#include "cli/capture_resume.hpp"

#include <gtest/gtest.h>

namespace tidemark::cli::fingerprint_test {

using namespace host;

CapturePlan plan_of(const char* text) {
    CapturePlan plan;
    plan.scene.passes.resize(1);
    plan.scene.passes[0].text.append(text, "a.glsl", 1);
    plan.output = *OutputName::parse("a_%d.png", 2);
    return plan;
}

Fingerprint run_of(const CapturePlan& plan, const gl::Capabilities& driver) {
    Fingerprint run = identity_of_run(plan);
    run.set_device(driver);
    return run;
}

Fingerprint run_of(const CapturePlan& plan, const char* renderer = "one") {
    gl::Capabilities driver;
    driver.renderer = renderer;
    return run_of(plan, driver);
}

TEST(Fingerprint, survives_conversion_to_text) {
    const Fingerprint frame = run_of(plan_of("a")).of_frame({.frame = 3});
    EXPECT_EQ(Fingerprint::parse(frame.text()), frame);
    EXPECT_EQ(frame.differences(Fingerprint::parse(frame.text())), "");
}

TEST(Fingerprint, names_the_differences) {
    const Fingerprint run = run_of(plan_of("a"));
    EXPECT_EQ(run.of_frame({.frame = 3}).differences(run.of_frame({.frame = 4})),
              "another time, size, mouse or camera");
    EXPECT_EQ(run.differences(run_of(plan_of("b"))), "another text of the scene");
    gl::Capabilities processor; // whose reciprocals are rounded otherwise
    processor.renderer = "one";
    processor.processor = "AuthenticAMD";
    EXPECT_EQ(run.differences(run_of(plan_of("a"), processor)), "another device or driver");
    CapturePlan channel = plan_of("a");
    channel.scene.passes[0].channels[2].sampling.vflip = false;
    EXPECT_EQ(run.differences(run_of(channel)), "other inputs");
    CapturePlan knob = plan_of("a");
    knob.scene.knobs.push_back({.name = "k"});
    EXPECT_EQ(run.differences(run_of(knob)), "other knobs");
    CapturePlan crop = plan_of("a");
    crop.area.crop = Rectangle{1, 2, {3, 4}};
    EXPECT_EQ(run.differences(run_of(crop)), "other drawing options");
    EXPECT_EQ(run.differences(Fingerprint::parse("what")),
              "another version of Tidemark, another device or driver, another text of the scene, other "
              "inputs, other "
              "knobs, other drawing options, something unknown to this version");
}

TEST(Fingerprint, on_another_device_differs_in_the_device_only) {
    const Fingerprint here = run_of(plan_of("a"));
    const Fingerprint there = run_of(plan_of("a"), "two");
    EXPECT_EQ(here.differences(there), "another device or driver");
    EXPECT_EQ(here.on_device_of(there), there);
    EXPECT_NE(here.on_device_of(there), run_of(plan_of("b"), "two"));
}

} // namespace tidemark::cli::fingerprint_test
