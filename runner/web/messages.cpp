#include "web/messages.hpp"

#include "host/json.hpp"
#include "web/page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace tidemark::web {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json knobs_of(const std::vector<overlay::KnobField>& fields) {
    Json knobs = Json::array();
    for (const overlay::KnobField& field : fields) {
        scene::Knob knob = field.knob;
        knob.value = field.value;
        knobs.push_back(web::knob_data(knob));
        knobs.back()["turned"] = field.is_turned();
    }
    return knobs;
}

Json definitions_of(const std::vector<overlay::DefinitionField>& fields) {
    Json definitions = Json::array();
    for (const overlay::DefinitionField& field : fields)
        definitions.push_back({{"name", field.name},
                               {"value", overlay::text_of(field)},
                               {"whole", field.whole},
                               {"held", field.held}});
    return definitions;
}

Json names_of(const std::vector<overlay::PictureField>& fields) {
    Json names = Json::array();
    for (const overlay::PictureField& field : fields)
        names.push_back(field.name);
    return names;
}

Json time_of(const overlay::TimeField& time) {
    Json data = {{"paused", time.paused},           {"speed", time.speed},
                 {"turnsBack", time.turns_back},    {"hasSpeed", time.has_speed},
                 {"from", or_null(time.loop_from)}, {"to", or_null(time.loop_to)}};
    if (time.stepping)
        data["stepping"] = {time.stepping->frame, time.stepping->last};
    return data;
}

std::string hex_of(const std::array<unsigned char, 3>& colour) {
    return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

/// The legend of the lens on show; null: the picture itself is on show.
Json lens_of(const std::optional<overlay::LensField>& lens) {
    if (!lens)
        return nullptr;
    Json bar = Json::array(), entries = Json::array();
    for (const auto& colour : lens->bar)
        bar.push_back(hex_of(colour));
    for (const overlay::LegendField& entry : lens->entries)
        entries.push_back({{"box", entry.box ? Json(hex_of(*entry.box)) : Json()}, {"words", entry.words}});
    return {{"title", lens->title},     {"basis", lens->basis},
            {"bar", std::move(bar)},    {"low", lens->low},
            {"high", lens->high},       {"mark", or_null(lens->mark)},
            {"pointer", lens->pointer}, {"entries", std::move(entries)},
            {"refusal", lens->refusal}, {"progress", lens->progress}};
}

Json lenses_of(const overlay::LensChooser& chooser) {
    Json choices = Json::array();
    for (const overlay::LensChoice& choice : chooser.choices)
        choices.push_back({{"name", choice.name},
                           {"says", choice.description},
                           {"refusal", choice.refusal},
                           {"takesLine", choice.takes_line},
                           {"needsLine", choice.needs_line},
                           {"second", choice.second}});
    return {{"choices", std::move(choices)},
            {"chosen", or_null(chooser.chosen)},
            {"place", chooser.place},
            {"variable", chooser.variable}};
}

Json errors_of(const std::vector<overlay::ErrorField>& fields) {
    constexpr size_t k_most_errors = 20;
    constexpr size_t k_longest_line = 100; // characters
    Json errors = Json::array();
    for (const overlay::ErrorField& field : fields) {
        if (errors.size() == k_most_errors)
            break;
        const overlay::Excerpt excerpt =
            overlay::excerpt_of(field.line, field.diagnostic.where.column, k_longest_line);
        errors.push_back({{"text", to_string(field.diagnostic)},
                          {"line", excerpt.text},
                          {"mark", field.line.empty() ? "" : excerpt.mark}});
    }
    return errors;
}

double in_hundredths(double value) {
    return std::round(value * 100) / 100;
}

using host::dump; // replaces bytes that are not UTF-8, which file names may contain

using Clock = std::chrono::steady_clock;

} // namespace

std::string state_text(const overlay::Model& model, Extent extent, SceneInput input) {
    return dump({{"state",
                  {{"size", {extent.width, extent.height}},
                   {"keyboard", input.keyboard},
                   {"everyMove", input.every_move},
                   {"camera", input.camera},
                   {"knobs", knobs_of(model.knobs)},
                   {"definitions", definitions_of(model.definitions)},
                   {"pictures", names_of(model.pictures)},
                   {"large", or_null(model.large)},
                   {"time", time_of(model.time)},
                   {"lenses", lenses_of(model.lenses)},
                   {"lens", lens_of(model.lens)},
                   {"errors", errors_of(model.errors)}}}});
}

std::string to_text(const PictureHead& head) {
    Json costs = Json::array();
    for (const auto& cost : head.costs)
        costs.push_back(cost ? Json(in_hundredths(*cost)) : Json());
    return dump({{"number", head.number},
                 {"seconds", head.seconds},
                 {"frame", head.frame},
                 {"costs", std::move(costs)},
                 {"draw", in_hundredths(head.draw_ms)},
                 {"encode", in_hundredths(head.encode_ms)}});
}

std::string line_text(const char* name, const std::string& line) {
    return dump({{name, line}});
}

PictureEncoder::PictureEncoder(Settings settings)
    : settings_(std::move(settings)), thread_([this] { run(); }) {}

PictureEncoder::~PictureEncoder() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        changed_.notify_one();
    }
    thread_.join();
}

void PictureEncoder::push(Job job) {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(job);
    changed_.notify_one();
}

bool PictureEncoder::has_room() const {
    const std::lock_guard lock(mutex_);
    return !waiting_;
}

void PictureEncoder::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ending_ || waiting_; });
        if (ending_)
            return;
        Job job = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        settings_.done(encoded(std::move(job)));
        lock.lock();
    }
}

NumberedPicture PictureEncoder::encoded(Job job) const {
    const auto begun = Clock::now();
    const std::string file = settings_.encode(job.picture);
    job.head.encode_ms = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    return {job.head.number, file.empty() ? nullptr : picture_message(job.head, file)};
}

SharedMessage picture_message(const PictureHead& picture, const std::string& file) {
    const std::string head = to_text(picture);
    std::string bytes;
    bytes.reserve(4 + head.size() + file.size());
    for (int byte = 0; byte < 4; ++byte)
        bytes += char(head.size() >> (8 * byte) & 0xFF);
    return std::make_shared<Message>(Message{std::move(bytes) + head + file, true});
}

} // namespace tidemark::web
