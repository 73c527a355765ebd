#include "window/overlay.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "base/process.hpp"
#include "scene/knob.hpp"
#include "shader/definitions.hpp"
#include "window/window_keys.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

namespace tidemark::window {

using namespace host;
namespace {

/// Returns the source line as the author wrote it; empty if it cannot be read.
std::string line_at(const SourceLocation& where, const scene::UnsavedTexts& unsaved) {
    std::error_code ignored;
    const auto held = unsaved.find(std::filesystem::weakly_canonical(where.file, ignored));
    const auto file = where.line <= 0         ? Result<std::string>("")
                      : held != unsaved.end() ? Result<std::string>(held->second)
                                              : read_text_file(where.file);
    const std::string text = file ? text::with_plain_line_ends(*file) : "";
    size_t begin = 0;
    for (int line = 1; line < where.line && begin < text.size(); ++line)
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    return begin < text.size() ? text.substr(begin, text.find('\n', begin) - begin) : "";
}

/// Returns the fields in order of importance: the first error with its notes, then the other diagnostics,
/// then the message about the whole scene. A diagnostic at the same place as the one before has no source
/// line.
std::vector<overlay::ErrorField> fields_of(const Error& error, const scene::UnsavedTexts& unsaved) {
    std::vector<overlay::ErrorField> fields;
    const SourceLocation* before = nullptr;
    for (const Diagnostic& diagnostic : error.diagnostics) {
        const bool again = before && diagnostic.where == *before;
        fields.push_back({diagnostic, again ? "" : line_at(diagnostic.where, unsaved)});
        before = &diagnostic.where;
    }
    const auto first = std::ranges::find_if(fields, [](const overlay::ErrorField& field) {
        return field.diagnostic.severity == Severity::error && field.diagnostic.where.line > 0;
    });
    if (first != fields.end())
        std::rotate(fields.begin(), first,
                    std::find_if(first + 1, fields.end(), [](const overlay::ErrorField& field) {
                        return field.diagnostic.severity != Severity::note;
                    }));
    if (!error.message.empty())
        fields.insert(first == fields.end() ? fields.begin() : fields.end(),
                      {{{}, Severity::error, error.message}, "", first != fields.end()});
    return fields;
}

/// Adds the MIDI binding of each component to the fields.
void add_controllers(std::vector<overlay::KnobField>& fields, const ControllerMap& map) {
    for (overlay::KnobField& field : fields)
        for (size_t i = 0; i < size_t(info(field.knob.type).components); ++i) {
            const KnobPart part{field.knob.name, i};
            const auto controller = map.controller_of(part);
            field.controllers.push_back({to_string(part, field.knob),
                                         controller ? to_string(*controller) : "", map.learning() == part});
        }
}

/// The argument formats for a line and a column.
enum class Form { plus_line, file_colon, goto_file_colon, options };

struct KnownEditor {
    std::string_view name;
    Form form;
    bool in_terminal;
};

constexpr KnownEditor k_editors[] = {
    {"code", Form::goto_file_colon, false},
    {"codium", Form::goto_file_colon, false},
    {"cursor", Form::goto_file_colon, false},
    {"subl", Form::file_colon, false},
    {"zed", Form::file_colon, false},
    {"kate", Form::options, false},
    {"hx", Form::file_colon, true},
    {"helix", Form::file_colon, true},
    {"vi", Form::plus_line, true},
    {"vim", Form::plus_line, true},
    {"nvim", Form::plus_line, true},
    {"nano", Form::plus_line, true},
    {"kak", Form::plus_line, true},
    {"micro", Form::plus_line, true},
};

/// Returns the editor's entry; the most common format for an unknown editor.
KnownEditor known(std::string_view program) {
    const std::string name = std::filesystem::path(program).filename().string();
    const auto* found = std::ranges::find(k_editors, name, &KnownEditor::name);
    return found == std::end(k_editors) ? KnownEditor{"", Form::plus_line, false} : *found;
}

std::vector<std::string> place_words(Form form, const SourceLocation& where) {
    const int line = std::max(where.line, 1);
    const int column = std::max(where.column, 1);
    const std::string place = fmt::format("{}:{}:{}", where.file, line, column);
    switch (form) {
    case Form::file_colon: return {place};
    case Form::goto_file_colon: return {"--goto", place};
    case Form::options: return {"-l", fmt::format("{}", line), "-c", fmt::format("{}", column), where.file};
    case Form::plus_line: return {fmt::format("+{}", line), where.file};
    }
    return {};
}

/// Starts the program in a session of its own, without access to our terminal. Returns 0 or an errno value.
int spawn_editor(const std::vector<std::string>& words, pid_t& child) {
    const std::vector<char*> arguments = argument_pointers(words);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    const int error = ::posix_spawnp(&child, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

const char* chosen_editor() {
    for (const char* variable : {"VISUAL", "EDITOR"})
        if (const char* value = std::getenv(variable); value && *value)
            return value;
    return nullptr;
}

} // namespace

bool ErrorBoard::show(const Error* error, const scene::UnsavedTexts& unsaved) {
    std::string text = error ? to_string(*error) : "";
    if (text == text_)
        return false;
    text_ = std::move(text);
    fields_ = error ? fields_of(*error, unsaved) : std::vector<overlay::ErrorField>{};
    return true;
}

void Messages::tell(std::string_view topic, std::string text, double now, double seconds) {
    if (!on_)
        return;
    end(topic);
    entries_.push_back({std::string(topic), std::move(text), now + seconds});
    due_ = now;
}

void Messages::retell(std::string_view topic, const std::string& text) {
    const auto entry = std::ranges::find(entries_, topic, &Entry::topic);
    if (entry == entries_.end() || std::exchange(entry->text, text) == text)
        return;
    due_ = -std::numeric_limits<double>::infinity();
}

void Messages::end(std::string_view topic) {
    if (std::erase_if(entries_, [&](const Entry& entry) { return entry.topic == topic; }) > 0)
        due_ = -std::numeric_limits<double>::infinity();
}

bool Messages::take_due(double now) {
    const bool due = now >= due_;
    if (due) // until they are shown
        due_ = std::numeric_limits<double>::infinity();
    return due;
}

std::vector<overlay::MessageField> Messages::fields(double now) {
    constexpr double k_fading_seconds = 0.5;
    constexpr double k_step_seconds = 1 / 20.0;
    std::erase_if(entries_, [&](const Entry& entry) { return entry.until <= now; });
    std::vector<overlay::MessageField> fields;
    due_ = std::numeric_limits<double>::infinity();
    for (const Entry& entry : entries_) {
        const double left = entry.until - now;
        fields.push_back({entry.text, std::min(1.0, left / k_fading_seconds)});
        due_ = std::min(
            due_, std::min(entry.until, std::max(entry.until - k_fading_seconds, now + k_step_seconds)));
    }
    return fields;
}

std::string changed_words(const Edits& before, const Edits& after) {
    std::vector<std::string> words;
    const auto add_knobs = [&](const Edits& edits, const Edits& others) {
        for (const scene::KnobSetting& knob : edits.knobs)
            if (std::ranges::find(others.knobs, knob) == others.knobs.end() &&
                std::ranges::find(words, knob.name) == words.end())
                words.push_back(knob.name);
    };
    add_knobs(after, before);
    add_knobs(before, after);
    if (before.camera != after.camera)
        words.emplace_back("camera");
    if (before.defines != after.defines)
        words.emplace_back("definitions");
    if (before.views != after.views)
        words.emplace_back("views");
    return fmt::format("{}", fmt::join(words, ", "));
}

void History::follow(Edits now, double time, bool held) {
    constexpr double k_pause_seconds = 0.5;
    constexpr size_t k_most_steps = 500;
    if (!current_ || now == *current_) {
        held_ = held_ && held;
        current_ = std::move(now);
        return;
    }
    std::string changed = changed_words(*current_, now);
    const bool quick = !held && time - changed_at_ < k_pause_seconds && changed == changed_;
    const bool same_step = held_ || quick; // a release without a change clears `held_`
    if (!same_step || before_.empty())
        before_.push_back(*std::move(current_));
    if (before_.size() > k_most_steps)
        before_.erase(before_.begin());
    undone_.clear();
    current_ = std::move(now);
    changed_at_ = time;
    changed_ = std::move(changed);
    held_ = held;
}

std::optional<Edits> History::undo() {
    return go(before_, undone_);
}

std::optional<Edits> History::redo() {
    return go(undone_, before_);
}

std::optional<Edits> History::go(std::vector<Edits>& from, std::vector<Edits>& to) {
    if (from.empty() || !current_)
        return std::nullopt;
    to.push_back(std::exchange(*current_, std::move(from.back())));
    from.pop_back();
    changed_at_ = -std::numeric_limits<double>::infinity(); // a change after this is a step of its own
    held_ = false;
    return current_;
}

std::vector<overlay::KnobField> knob_fields(const scene::Scene& scene,
                                            const std::vector<scene::KnobSetting>& turned) {
    std::vector<overlay::KnobField> fields;
    for (const scene::Knob& knob : scene.knobs)
        fields.push_back({knob, value_after(knob, turned)});
    return fields;
}

std::vector<overlay::DefinitionField> definition_fields(const scene::Scene& scene,
                                                        const SceneRequest& request) {
    std::vector<scene::Setting> held;
    for (const std::string& text : request.defines)
        if (const auto split = scene::split_setting(text, "--define"))
            set(held, {std::string(split->first), std::string(split->second)});
    std::vector<overlay::DefinitionField> fields;
    for (const glsl::NamedText& definition : glsl::plain_numbers(scene)) {
        const auto other = std::ranges::find(held, definition.name, &scene::Setting::name);
        const bool is_held = other != held.end();
        if (auto field =
                overlay::definition_field(definition.name, is_held ? other->value : definition.text, is_held))
            fields.push_back(*std::move(field));
    }
    return fields;
}

void Overlay::toggle(Panel panel) {
    bool& open = panel == Panel::help ? help_open_ : controls_open_;
    open = !open;
    mark_changed();
}

bool Overlay::show_origin(const Error* origin) {
    const bool differs = origin_.show(origin);
    mark_changed_if(differs);
    return differs;
}

void Overlay::forget_scene() {
    definitions_.reset();
    show_origin(nullptr);
}

std::string Overlay::keep(Preset view) {
    auto views = std::make_shared<std::vector<Preset>>(*views_);
    for (size_t number = views->size() + 1; view.name.empty(); ++number) {
        const std::string name = fmt::format("view {}", number);
        if (std::ranges::find(*views, name, &Preset::name) == views->end())
            view.name = name;
    }
    views->push_back(std::move(view));
    std::string text = fmt::format("{}: {}", views->back().name, label_of(views->back()));
    set_views(std::move(views));
    return text;
}

void Overlay::forget_view(size_t index) {
    if (index >= views_->size())
        return;
    auto views = std::make_shared<std::vector<Preset>>(*views_);
    views->erase(views->begin() + std::ptrdiff_t(index));
    set_views(std::move(views));
}

Result<void> Overlay::rename_view(size_t index, const std::string& name) {
    if (index >= views_->size() || name == (*views_)[index].name)
        return {};
    mark_changed(); // a refused name is replaced
    if (name.empty())
        return fail(ErrorCode::usage, "a view needs a name");
    if (std::ranges::find(*views_, name, &Preset::name) != views_->end())
        return fail(ErrorCode::usage, fmt::format("another view has the name '{}'", name));
    auto views = std::make_shared<std::vector<Preset>>(*views_);
    (*views)[index].name = name;
    set_views(std::move(views));
    return {};
}

void Overlay::set_views(std::shared_ptr<const std::vector<Preset>> views) {
    views_ = std::move(views);
    mark_changed();
}

void Overlay::set_morph(double seconds) {
    morph_seconds_ = seconds;
    mark_changed();
}

void Overlay::restore(bool controls_open, double morph_seconds, std::vector<Binding> controllers) {
    controls_open_ = controls_open;
    morph_seconds_ = morph_seconds;
    controllers_ = ControllerMap(std::move(controllers));
}

overlay::Model Overlay::model(const scene::Scene* scene, const SceneRequest& request,
                              const std::vector<scene::KnobSetting>& turned, bool midi, double now) {
    changed_ = false;
    overlay::Model model{.controls = controls_open_ && scene,
                         .errors = errors_.fields().empty() ? origin_.fields() : errors_.fields()};
    if (model.controls) {
        if (!definitions_)
            definitions_ = definition_fields(*scene, request);
        model.definitions = *definitions_;
        model.knobs = knob_fields(*scene, turned);
        if (midi)
            add_controllers(model.knobs, controllers_);
        for (const Preset& view : *views_)
            model.views.push_back({view.name, label_of(view)});
        model.morph_seconds = morph_seconds_;
    }
    model.messages = messages_.fields(now);
    if (help_open_) {
        for (const KeyRow& row : key_rows())
            model.help.push_back({std::string(row.keys), std::string(row.meaning)});
        model.help_footer = k_keys_of_scenes;
    }
    return model;
}

bool Overlay::change_title(const std::string& title) {
    return std::exchange(title_, title) != title;
}

std::vector<std::string> editor_words(std::string_view editor, const SourceLocation& where) {
    std::vector<std::string> words = split_words(editor);
    if (words.empty())
        return words;
    const KnownEditor kind = known(words.front());
    for (std::string& word : place_words(kind.form, where))
        words.push_back(std::move(word));
    if (kind.in_terminal)
        words.insert(words.begin(), {"x-terminal-emulator", "-e"});
    return words;
}

Result<void> open_editor(const SourceLocation& where) {
    const char* editor = chosen_editor();
    const auto words = editor_words(editor ? editor : "", where);
    if (words.empty())
        return fail(ErrorCode::usage, "no editor to open: set VISUAL or EDITOR, as in VISUAL='code --wait'");
    pid_t child = 0;
    if (const int error = spawn_editor(words, child); error != 0)
        return fail(ErrorCode::usage,
                    fmt::format("cannot start the editor '{}': {}", words.front(), std::strerror(error)));
    std::thread([child] { ::waitpid(child, nullptr, 0); }).detach(); // prevents a zombie
    return {};
}

} // namespace tidemark::window
