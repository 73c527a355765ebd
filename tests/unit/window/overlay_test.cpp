// The contents of the panels, and the edits that they keep.
#include "support/scene_of.hpp"
#include "window/overlay.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace tidemark::window::overlay_test {

using namespace host;

using Panel = Overlay::Panel;

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

Preset view_at(double seconds) {
    return {.name = "", .seconds = seconds};
}

std::string labels_of(const overlay::Model& model) {
    std::string labels;
    for (const overlay::ViewField& view : model.views)
        labels += fmt::format("{}: {}\n", view.name, view.label);
    return labels;
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
    overlay::Model model = overlay.model(&scene, {}, {}, false);
    EXPECT_EQ(model.panels(), overlay::Model::Panels{});
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

TEST(Overlay, controls_are_hidden_without_a_scene) {
    Overlay overlay(true);
    EXPECT_FALSE(overlay.model(nullptr, {}, {}, false).controls);
}

TEST(Overlay, is_outdated_until_shown) {
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
    Preset view = view_at(2.5);
    view.knobs = {{"height", {1, {2}}}};
    EXPECT_EQ(overlay.keep(view), "view 1: 2.500 s, height = 2");
    overlay.keep(view_at(1));
    EXPECT_TRUE(overlay.changed());
    EXPECT_EQ(labels_of(overlay.model(&scene, {}, {}, false)),
              "view 1: 2.500 s, height = 2\nview 2: 1.000 s\n");
    overlay.forget_view(0);
    overlay.forget_view(7); // there is none
    EXPECT_EQ(labels_of(overlay.model(&scene, {}, {}, false)), "view 2: 1.000 s\n");
    EXPECT_EQ(overlay.keep(view_at(3)), "view 3: 3.000 s") << "no name twice";
}

TEST(Overlay, renames_views) {
    Overlay overlay(true);
    overlay.keep(view_at(1));
    overlay.keep(view_at(2));
    EXPECT_TRUE(overlay.rename_view(0, "dawn"));
    EXPECT_FALSE(overlay.rename_view(1, "dawn"));
    EXPECT_FALSE(overlay.rename_view(1, ""));
    EXPECT_TRUE(overlay.rename_view(9, "x"));
    EXPECT_EQ(overlay.views()[0].name, "dawn");
    EXPECT_EQ(overlay.views()[1].name, "view 2");
}

TEST(Overlay, shows_controllers_where_there_is_a_midi_device) {
    Overlay overlay(true);
    const scene::Scene scene = scene_with("");
    overlay.restore(true, 2, {{{1, 7}, {"width", 0}}});
    EXPECT_TRUE(overlay.model(&scene, {}, {}, false).knobs.at(1).controllers.empty());
    overlay.controllers().learn({"height", 0});
    const overlay::Model model = overlay.model(&scene, {}, {}, true);
    EXPECT_TRUE(model.knobs.at(0).controllers.at(0).learning);
    EXPECT_EQ(model.knobs.at(1).controllers.at(0).controller, "controller 7");
    EXPECT_EQ(model.morph_seconds, 2);
}

std::string words_at(Messages& messages, double now) {
    std::string words;
    for (const overlay::MessageField& field : messages.fields(now))
        words += fmt::format("{}={:.1f} ", field.text, field.opacity);
    return words;
}

TEST(Messages, fade_after_three_seconds) {
    Messages messages;
    EXPECT_FALSE(messages.take_due(100));
    messages.tell("saved", "saving a.png", 100);
    EXPECT_TRUE(messages.take_due(100));
    EXPECT_FALSE(messages.take_due(100)) << "the caller shows them now";
    EXPECT_EQ(words_at(messages, 100), "saving a.png=1.0 ");
    EXPECT_EQ(messages.due(), 102.5) << "nothing changes before";
    EXPECT_EQ(words_at(messages, 102.75), "saving a.png=0.5 ");
    EXPECT_TRUE(messages.take_due(102.85));
    EXPECT_EQ(words_at(messages, 103), "");
    EXPECT_FALSE(messages.take_due(1e9));
}

TEST(Messages, a_topic_has_one_message) {
    Messages messages;
    messages.tell("marks", "marks are on", 0);
    messages.tell("saved", "saving a.png", 0);
    messages.tell("marks", "marks are off", 1);
    EXPECT_EQ(words_at(messages, 1), "saving a.png=1.0 marks are off=1.0 ");
    messages.retell("saved", "saved a.png");
    messages.retell("gone", "nothing");
    EXPECT_TRUE(messages.take_due(1));
    EXPECT_EQ(words_at(messages, 1), "saved a.png=1.0 marks are off=1.0 ");
}

TEST(Messages, stay_until_their_end) {
    Messages messages;
    messages.tell("trace", "tracing", 0, std::numeric_limits<double>::infinity());
    EXPECT_EQ(words_at(messages, 1e6), "tracing=1.0 ");
    EXPECT_FALSE(messages.take_due(1e9));
    messages.end("trace");
    EXPECT_TRUE(messages.take_due(1e9));
    EXPECT_EQ(words_at(messages, 1e9), "");
}

TEST(Messages, can_be_turned_off) {
    Messages messages;
    messages.turn_off();
    messages.tell("saved", "saving a.png", 0);
    EXPECT_EQ(words_at(messages, 0), "");
}

TEST(Overlay, shows_messages_without_any_panel) {
    Overlay overlay(false);
    overlay.messages().tell("saved", "saving a.png", 5);
    const overlay::Model model = overlay.model(nullptr, {}, {}, false, 6);
    EXPECT_EQ(model.messages.at(0).text, "saving a.png");
    EXPECT_NE(model.panels(), overlay::Model::Panels{});
    EXPECT_TRUE(overlay.model(nullptr, {}, {}, false, 9).messages.empty());
}

Edits edits_with(double height) {
    return {.knobs = {{"height", {1, {height}}}}};
}

TEST(History, moves_back_and_forth_by_steps) {
    History history;
    history.adopt({});
    EXPECT_FALSE(history.undo());
    history.follow(edits_with(1), 10, false);
    history.follow(edits_with(2), 20, false);
    EXPECT_EQ(history.undo(), edits_with(1));
    EXPECT_EQ(history.undo(), Edits{});
    EXPECT_FALSE(history.undo());
    EXPECT_EQ(history.redo(), edits_with(1));
    EXPECT_EQ(history.redo(), edits_with(2));
    EXPECT_FALSE(history.redo());
    EXPECT_EQ(history.undo(), edits_with(1));
    history.follow(edits_with(1), 21, false);
    EXPECT_EQ(history.redo(), edits_with(2)) << "nothing has changed";
    EXPECT_EQ(history.undo(), edits_with(1));
    history.follow(edits_with(3), 22, false);
    EXPECT_FALSE(history.redo()) << "a change ends what was undone";
    EXPECT_EQ(history.undo(), edits_with(1));
}

TEST(History, a_drag_is_a_single_step) {
    History history;
    history.adopt({});
    for (int i = 0; i <= 10; ++i)
        history.follow(edits_with(1 + i), 10 + i, true); // a second each
    history.follow(edits_with(11), 21, false);           // released
    history.follow(edits_with(20), 30, true);
    EXPECT_EQ(history.undo(), edits_with(11));
    EXPECT_EQ(history.undo(), Edits{});
}

TEST(History, a_release_with_the_last_change_belongs_to_the_drag) {
    History history;
    history.adopt({});
    history.follow(edits_with(1), 10, true);
    history.follow(edits_with(2), 12, false); // a slow frame: moved and released between two calls
    history.follow(edits_with(3), 20, false);
    EXPECT_EQ(history.undo(), edits_with(2));
    EXPECT_EQ(history.undo(), Edits{});
}

TEST(History, quick_changes_are_one_step) {
    History history;
    history.adopt({});
    history.follow(edits_with(1), 10, false);
    history.follow(edits_with(2), 10.2, false); // notches of a wheel
    history.follow(edits_with(3), 10.4, false);
    history.follow(edits_with(4), 12, false);
    EXPECT_EQ(history.undo(), edits_with(3));
    EXPECT_EQ(history.undo(), Edits{});
}

TEST(History, two_quick_drags_are_two_steps) {
    History history;
    history.adopt({});
    history.follow(edits_with(1), 10, true);
    history.follow(edits_with(1), 10.1, false); // released
    history.follow(edits_with(2), 10.2, true);
    Edits moved = edits_with(2);
    moved.camera.distance = 3;
    history.follow(edits_with(2), 10.3, false);
    history.follow(moved, 10.4, false);
    EXPECT_EQ(history.undo(), edits_with(2));
    EXPECT_EQ(history.undo(), edits_with(1));
    EXPECT_EQ(history.undo(), Edits{});
}

TEST(History, a_reload_is_not_a_step) {
    History history;
    history.adopt({});
    history.follow(edits_with(1), 10, false);
    history.adopt(edits_with(5));
    history.follow(edits_with(6), 20, false);
    EXPECT_EQ(history.undo(), edits_with(5));
    EXPECT_EQ(history.undo(), Edits{});
}

TEST(History, names_the_changed_settings) {
    Edits after{.knobs = {{"height", {1, {2}}}}, .defines = {"STEPS=3"}};
    after.camera.distance = 3;
    after.views = std::make_shared<std::vector<Preset>>();
    EXPECT_EQ(changed_words({}, after), "height, camera, definitions, views");
    EXPECT_EQ(changed_words(edits_with(1), edits_with(2)), "height");
    EXPECT_EQ(changed_words(edits_with(1), {}), "height");
}

TEST(Overlay, kept_views_can_be_brought_back) {
    Overlay overlay(true);
    const auto none = overlay.kept_views();
    overlay.keep(view_at(1));
    const auto one = overlay.kept_views();
    overlay.forget_view(0);
    EXPECT_TRUE(none->empty());
    EXPECT_EQ(one->size(), 1U);
    overlay.set_views(one);
    EXPECT_EQ(overlay.views().size(), 1U);
}

TEST(Overlay, an_error_has_a_separate_summary) {
    Overlay overlay(false);
    Error error{ErrorCode::load, "the scene does not compile"};
    error.diagnostics.push_back({{"a.glsl", 1, 1}, Severity::error, "wrong"});
    overlay.show_error(&error);
    const overlay::Model model = overlay.model(nullptr, {}, {}, false);
    ASSERT_EQ(model.errors.size(), 2U);
    EXPECT_FALSE(model.errors[0].summary);
    EXPECT_TRUE(model.errors[1].summary);
    error.diagnostics.clear();
    overlay.show_error(&error);
    EXPECT_FALSE(overlay.model(nullptr, {}, {}, false).errors.at(0).summary) << "it is the error itself";
}

TEST(Overlay, a_title_is_set_once) {
    Overlay overlay(false);
    EXPECT_TRUE(overlay.change_title("a"));
    EXPECT_FALSE(overlay.change_title("a"));
    EXPECT_TRUE(overlay.change_title("b"));
}

} // namespace tidemark::window::overlay_test
