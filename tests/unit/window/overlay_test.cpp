// The contents of the panels, and the edits that they keep.
#include "support/scene_of.hpp"
#include "window/overlay.hpp"

#include <gmock/gmock.h>

namespace tidemark::cli::overlay_test {

using Panel = Overlay::Panel;
using testing::ElementsAre;

scene::Knob knob(const char* name, double initial) {
    scene::Knob knob;
    knob.name = name;
    knob.value = knob.initial = {initial};
    return knob;
}

scene::Scene scene_with(const char* text) {
    scene::Scene scene = scene_of(text);
    scene.knobs = {knob("height", 1), knob("width", 2)};
    return scene;
}

Moment view_at(double seconds) {
    Moment view;
    view.sequence.state.time = seconds;
    return view;
}

TEST(Overlay, knobs_have_their_current_values) {
    const scene::Scene scene = scene_with("");
    const auto fields = knob_fields(scene, {{"width", {1, {5}}}, {"gone", {1, {3}}}});
    ASSERT_EQ(fields.size(), 2U);
    EXPECT_EQ(fields[0].knob.name, "height");
    EXPECT_EQ(fields[0].value, scene::KnobValue{1});
    EXPECT_FALSE(fields[0].is_turned());
    EXPECT_EQ(fields[1].value, scene::KnobValue{5});
    EXPECT_TRUE(fields[1].is_turned());
}

TEST(Overlay, definitions_are_the_numbers_with_the_users_values) {
    SceneRequest request;
    request.defines = {"STEPS=12", "ELSE=3"};
    const auto fields =
        definition_fields(scene_with("#define STEPS 8\n#define FAR 2.5\n#define NAME a\n"), request);
    ASSERT_EQ(fields.size(), 2U);
    EXPECT_EQ(fields[0].name, "STEPS");
    EXPECT_EQ(fields[0].value, 12);
    EXPECT_TRUE(fields[0].held);
    EXPECT_EQ(fields[1].name, "FAR");
    EXPECT_EQ(fields[1].value, 2.5);
    EXPECT_FALSE(fields[1].held);
}

TEST(Overlay, shows_only_open_panels) {
    Overlay overlay(false);
    const scene::Scene scene = scene_with("#define STEPS 8\n");
    live::Model model = overlay.model(&scene, {}, {}, false);
    EXPECT_EQ(model.panels(), live::Model::Panels{});
    EXPECT_TRUE(model.knobs.empty());
    overlay.toggle(Panel::controls);
    overlay.toggle(Panel::help);
    EXPECT_TRUE(overlay.shows(Panel::controls));
    EXPECT_TRUE(overlay.shows(Panel::help));
    model = overlay.model(&scene, {}, {{"height", {1, {4}}}}, false);
    EXPECT_TRUE(model.controls);
    EXPECT_EQ(model.knobs.at(0).value, scene::KnobValue{4});
    EXPECT_EQ(model.definitions.at(0).name, "STEPS");
    EXPECT_FALSE(model.help.empty());
    EXPECT_FALSE(model.help_footer.empty());
    overlay.toggle(Panel::help);
    EXPECT_TRUE(overlay.model(&scene, {}, {}, false).help.empty());
}

TEST(Overlay, controls_wait_for_a_scene) {
    Overlay overlay(true);
    EXPECT_FALSE(overlay.model(nullptr, {}, {}, false).controls);
}

TEST(Overlay, is_out_of_date_until_it_is_shown) {
    Overlay overlay(false);
    EXPECT_FALSE(overlay.changed());
    overlay.mark_changed_if(false);
    EXPECT_FALSE(overlay.changed());
    overlay.toggle(Panel::help);
    EXPECT_TRUE(overlay.changed());
    overlay.model(nullptr, {}, {}, false);
    EXPECT_FALSE(overlay.changed());
    const Error error{ErrorCode::load, "wrong"};
    overlay.show_error(&error);
    EXPECT_TRUE(overlay.changed());
    overlay.model(nullptr, {}, {}, false);
    overlay.show_error(&error);
    EXPECT_FALSE(overlay.changed()) << "the same error is shown already";
}

TEST(Overlay, an_error_of_the_files_hides_the_origin_of_a_nan) {
    Overlay overlay(false);
    const Error origin{ErrorCode::check_failed, "sqrt of -1"};
    EXPECT_TRUE(overlay.show_origin(&origin));
    EXPECT_FALSE(overlay.show_origin(&origin));
    const auto message = [&] {
        return overlay.model(nullptr, {}, {}, false).errors.at(0).diagnostic.message;
    };
    EXPECT_EQ(message(), "sqrt of -1");
    const Error error{ErrorCode::load, "wrong"};
    overlay.show_error(&error);
    EXPECT_EQ(message(), "wrong");
    overlay.show_error(nullptr);
    EXPECT_EQ(message(), "sqrt of -1");
    overlay.forget_scene();
    EXPECT_TRUE(overlay.model(nullptr, {}, {}, false).errors.empty());
}

TEST(Overlay, reads_definitions_again_in_another_scene) {
    Overlay overlay(true);
    const scene::Scene before = scene_with("#define STEPS 8\n");
    const scene::Scene now = scene_with("#define STEPS 9\n");
    EXPECT_EQ(overlay.model(&before, {}, {}, false).definitions.at(0).value, 8);
    overlay.forget_scene();
    EXPECT_EQ(overlay.model(&now, {}, {}, false).definitions.at(0).value, 9);
}

TEST(Overlay, keeps_views_with_labels) {
    Overlay overlay(true);
    const scene::Scene scene = scene_with("");
    Moment view = view_at(2.5);
    view.sequence.state.knobs = {{"height", {1, {2}}}};
    EXPECT_EQ(overlay.keep(view), "2.500 s, height = 2");
    overlay.keep(view_at(1));
    EXPECT_TRUE(overlay.changed());
    EXPECT_THAT(overlay.model(&scene, {}, {}, false).views, ElementsAre("2.500 s, height = 2", "1.000 s"));
    overlay.forget_view(0);
    overlay.forget_view(7); // there is none
    EXPECT_THAT(overlay.model(&scene, {}, {}, false).views, ElementsAre("1.000 s"));
    EXPECT_EQ(overlay.views().size(), 1U);
}

TEST(Overlay, shows_controllers_where_there_is_a_midi_device) {
    Overlay overlay(true);
    const scene::Scene scene = scene_with("");
    overlay.restore(true, {view_at(3)}, {{{1, 7}, {"width", 0}}});
    EXPECT_TRUE(overlay.model(&scene, {}, {}, false).knobs.at(1).controllers.empty());
    overlay.controllers().learn({"height", 0});
    const live::Model model = overlay.model(&scene, {}, {}, true);
    EXPECT_TRUE(model.knobs.at(0).controllers.at(0).learning);
    EXPECT_EQ(model.knobs.at(1).controllers.at(0).controller, "controller 7");
    EXPECT_THAT(model.views, ElementsAre("3.000 s"));
}

TEST(Overlay, a_title_is_set_once) {
    Overlay overlay(false);
    EXPECT_TRUE(overlay.change_title("a"));
    EXPECT_FALSE(overlay.change_title("a"));
    EXPECT_TRUE(overlay.change_title("b"));
}

} // namespace tidemark::cli::overlay_test
