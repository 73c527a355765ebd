#include "lab/lens.hpp"

#include "base/encoding.hpp"
#include "lab/march_hits.hpp"
#include "lab/pass_function.hpp"
#include "shader/march_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// In the order of LensName.
constexpr LensForm k_forms[] = {
    {"cost", "cost", "weighted operations that each pixel executes", LineUse::none},
    {"steps", "steps[:LINE]", "iterations of the march that each pixel takes; those that run out are marked",
     LineUse::optional},
    {"error", "error", "float against double, in steps of 1/255", LineUse::none},
    {"rounding", "rounding",
     "largest change of the pixel with the arithmetic of other GPUs, in steps of 1/255", LineUse::none},
    {"proof", "proof", "where the march is proved right, steps over its first hit, or misses it",
     LineUse::none},
    {"clocks", "clocks", "cycles of the device's clock that each pixel takes, with those that run with it",
     LineUse::none},
    {"value", "value:LINE[:NAME]", "the value of a variable or an expression of a line", LineUse::required,
     "name"},
    {"branch", "branch:LINE[:N]", "which way a condition went, and where neighbouring pixels part",
     LineUse::required, "number"},
};
static_assert(std::size(k_forms) == k_lenses);

std::string forms() {
    std::string text;
    for (const LensForm& each : k_forms)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", each.form);
    return text;
}

/// Reads the line at the front of `parts`, which may follow a file; removes both.
std::optional<SourceLocation> take_place(std::vector<std::string>& parts) {
    SourceLocation place;
    for (size_t i = 0; i < std::min<size_t>(2, parts.size()); ++i) {
        const auto line = number_from<int>(parts[i]);
        if (!line || *line < 1)
            continue;
        place.line = *line;
        if (i == 1)
            place.file = parts[0];
        parts.erase(parts.begin(), parts.begin() + long(i) + 1);
        return place;
    }
    return std::nullopt;
}

std::vector<std::string> split_lens(std::string_view text) {
    std::vector<std::string> parts;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(':', begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// Reads `@min`, `@max`, `@last` or `@N` at the end and removes it. Returns false for anything else.
bool take_pick(std::string& text, Lens& lens) {
    using Pick = glsl::SeenValue::Pick;
    const size_t at = text.rfind('@');
    if (at == std::string::npos)
        return true;
    const std::string pick = text.substr(at + 1);
    text.resize(at);
    lens.pick = pick == "min" ? Pick::least : pick == "max" ? Pick::most : Pick::last;
    if (pick == "min" || pick == "max" || pick == "last")
        return true;
    const auto number = number_from<uint32_t>(pick);
    if (!number || *number < 1)
        return false;
    lens.pick = Pick::number;
    lens.number = *number;
    return true;
}

bool is_variable(std::string_view text) {
    return std::ranges::all_of(
        text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; });
}

} // namespace

std::string_view to_string(LensName name) {
    return form_of(name).name;
}

const LensForm& form_of(LensName name) {
    return k_forms[size_t(name)];
}

std::string_view to_string(Basis basis) {
    switch (basis) {
    case Basis::counted: return "counted";
    case Basis::measured: return "measured";
    case Basis::modelled: return "modelled";
    case Basis::proved: break;
    }
    return "proved";
}

Result<Lens> parse_lens(std::string_view text) {
    const auto refuse = [](std::string why) { return fail(ErrorCode::usage, std::move(why)); };
    std::string rest(text);
    Lens lens;
    if (!take_pick(rest, lens))
        return refuse("after @ give min, max, last or a number from 1");
    std::vector<std::string> parts = split_lens(rest);
    const auto row = std::ranges::find(k_forms, parts[0], &LensForm::name);
    if (row == std::end(k_forms))
        return refuse("give one of " + forms());
    lens.name = LensName(row - k_forms);
    const bool takes_place = row->line != LineUse::none;
    if (lens.name != LensName::value && rest != text)
        return refuse("only value has @min, @max, @last and @N");
    parts.erase(parts.begin());
    if (parts.empty() && row->line != LineUse::required)
        return lens;
    if (takes_place)
        lens.place = take_place(parts);
    if (!lens.place && takes_place)
        return refuse(fmt::format("give a line from 1, as in {}:12", row->name));
    if (lens.name == LensName::value && parts.size() == 1 && !parts[0].empty() && is_variable(parts[0])) {
        lens.variable = parts[0];
        return lens;
    }
    if (lens.name == LensName::branch) {
        lens.number = 0;
        if (parts.size() == 1)
            lens.number = number_from<uint32_t>(parts[0]).value_or(0);
        if (parts.size() == 1 && lens.number > 0)
            return lens;
    }
    if (!parts.empty() || !takes_place)
        return refuse(fmt::format("give {}", row->form));
    return lens;
}

std::string to_string(const Lens& lens) {
    using Pick = glsl::SeenValue::Pick;
    std::string text(to_string(lens.name));
    if (lens.place)
        text +=
            (lens.place->file.empty() ? "" : ":" + lens.place->file) + fmt::format(":{}", lens.place->line);
    if (!lens.variable.empty())
        text += ":" + lens.variable;
    if (lens.name == LensName::branch && lens.number > 0)
        text += fmt::format(":{}", lens.number);
    if (lens.name == LensName::value && lens.pick != Pick::last)
        text += lens.pick == Pick::least  ? "@min"
                : lens.pick == Pick::most ? "@max"
                                          : fmt::format("@{}", lens.number);
    return text;
}

namespace {

constexpr LensClass k_sides[] = {
    {"false", {0, 32, 77}}, {"true", {255, 234, 70}}, {"both in one pixel", {124, 123, 120}}};

/// Returns the march at that line: its test, or any line of its loop. All marches without a line.
Result<std::vector<glsl::MarchLines>> chosen_marches(const PassFunction& image, const Lens& lens,
                                                     const glsl::ParsedText& text,
                                                     const glsl::TreeFacts& facts) {
    std::vector<glsl::MarchLines> marches = marches_of(image), chosen;
    if (!lens.place)
        return marches;
    const auto is_file = [&](const std::string& file) {
        return lens.place->file.empty() || lens.place->file == file;
    };
    for (const glsl::MarchLines& march : marches) {
        const auto nodes = glsl::find_march(text, facts, march);
        if (!nodes || !is_file(march.test.file))
            continue;
        const glsl::Node& loop = text.tree()[nodes->loop];
        if (text.used(loop.begin).line <= lens.place->line &&
            lens.place->line <= text.used(loop.end - 1).line)
            chosen.push_back(march);
    }
    if (chosen.size() > 1)
        std::erase_if(chosen, [&](const auto& march) { return march.test.line != lens.place->line; });
    return chosen;
}

/// Says how to count loops that are not known as a march; begins with a semicolon. Empty: there are no loops.
std::string words_on_loops(const glsl::ParsedText& text) {
    constexpr size_t k_most = 5;
    const std::vector<SourceLocation> loops = glsl::countable_loops(text);
    std::string list;
    for (size_t i = 0; i < std::min(loops.size(), k_most); ++i)
        list += fmt::format("{}{}", i == 0 ? "" : ", ",
                            to_string(Lens{.name = LensName::steps, .place = loops[i]}));
    if (loops.empty())
        return "";
    return fmt::format("; to count the iterations of any loop, give the line where it begins: {}{}", list,
                       loops.size() > k_most ? ", ..." : "");
}

/// Says that no march was found in the pass, and which buffer has one.
std::string words_on_no_march(const scene::Scene& scene, size_t pass) {
    const std::string words = fmt::format("no marching loop was found in {}", scene.passes[pass].name);
    for (const scene::Pass& other : scene.passes)
        if (other.kind == scene::PassKind::buffer && other.name != scene.passes[pass].name)
            if (const auto function = PassFunction::create(scene, other);
                function && !function->loops().empty())
                return fmt::format("{}; {} has one: add --pass \"{}\"", words, other.name, other.name);
    return words;
}

/// Instruments the march, or the loop of a line; sets the title and what is marked.
Result<text::MappedText> count_steps(LensPlan& plan, const PassFunction* function,
                                     const glsl::ParsedText& text, const glsl::TreeFacts& facts) {
    std::vector<glsl::MarchLines> marches;
    if (function)
        marches = TRY(chosen_marches(*function, plan.lens, text, facts));
    if (marches.empty()) {
        glsl::ValueText counted = TRY(glsl::count_iterations(text, facts, *plan.lens.place));
        plan.title = fmt::format("iterations of the loop at {}:{}, all entries", counted.place.file,
                                 counted.place.line);
        return std::move(counted.text);
    }
    const SourceLocation& test = marches.front().test;
    plan.title =
        marches.size() == 1
            ? fmt::format("iterations of the march at {}:{}", test.file, test.line)
            : fmt::format("iterations of the first of {} marches that a pixel enters", marches.size());
    plan.marked = "run out of iterations";
    return glsl::record_marches(text, facts, marches, glsl::RecordAnswer::steps);
}

Result<void> plan_steps(const scene::Scene& scene, LensPlan& plan) {
    plan.unit = "iterations";
    plan.absent = "no march";
    const scene::Pass& pass = scene.passes[plan.pass];
    const auto function = PassFunction::create(scene, pass);
    const RewriteText rewrite = [&](const auto& text, const auto& facts) -> Result<text::MappedText> {
        if (plan.lens.place)
            return count_steps(plan, function ? &*function : nullptr, text, facts);
        if (!function)
            return fail(ErrorCode::load, fmt::format("the text cannot be searched for a march: {}{}",
                                                     function.error().message, words_on_loops(text)));
        if (function->loops().empty())
            return fail(ErrorCode::load, words_on_no_march(scene, plan.pass) + words_on_loops(text));
        return count_steps(plan, &*function, text, facts).map_error([&](Error error) {
            error.message += words_on_loops(text);
            return error;
        });
    };
    plan.drawn = TRY(with_hit_text(scene, plan.pass, rewrite));
    return {};
}

std::string words_for(const Lens& lens) {
    using Pick = glsl::SeenValue::Pick;
    switch (lens.pick) {
    case Pick::least: return "minimum of ";
    case Pick::most: return "maximum of ";
    case Pick::number: return fmt::format("value {} of ", lens.number);
    case Pick::last: break;
    }
    return "last value of ";
}

Result<void> plan_value(const scene::Scene& scene, LensPlan& plan) {
    glsl::ValueText shown;
    const Lens& lens = plan.lens;
    const RewriteText rewrite = [&](const auto& text, const auto& facts) -> Result<text::MappedText> {
        if (lens.name == LensName::value)
            shown = TRY(glsl::show_value(text, facts, {*lens.place, lens.variable, lens.pick, lens.number}));
        else
            shown = TRY(glsl::show_branch(text, facts, *lens.place, int(lens.number)));
        return shown.text;
    };
    plan.drawn = TRY(with_hit_text(scene, plan.pass, rewrite));
    plan.excerpt = shown.excerpt;
    plan.absent = "not reached";
    const std::string at = fmt::format("{}:{}", shown.place.file, shown.place.line);
    if (lens.name == LensName::branch) {
        plan.classes = k_sides;
        constexpr size_t k_longest = 80;
        plan.title = shown.excerpt.size() > k_longest
                         ? fmt::format("{}... at {}", shown.excerpt.substr(0, k_longest - 3), at)
                         : fmt::format("{} at {}", shown.excerpt, at);
        return {};
    }
    plan.components = shown.components == 0 ? 0 : shown.components > 1 ? 3 : 1;
    plan.title = fmt::format("{}{} at {}", words_for(lens), shown.name, at);
    if (plan.components != 1)
        plan.unit = "x y z as red, green, blue";
    return {};
}

Result<void> plan_cost(const scene::Scene& scene, LensPlan& plan, const glsl::WorkWeights& weights) {
    const RewriteText rewrite = [&](const auto& text, const auto& facts) -> Result<text::MappedText> {
        return TRY(glsl::count_operations(text, facts, glsl::WorkAnswer::total, weights)).text;
    };
    plan.more_basis = basis_of(weights);
    plan.drawn = TRY(with_hit_text(scene, plan.pass, rewrite));
    plan.title = "weighted operations executed";
    plan.unit = "operations";
    return {};
}

Result<void> plan_clocks(const scene::Scene& scene, LensPlan& plan) {
    const RewriteText rewrite = [](const auto& text, const auto& facts) {
        return glsl::measure_clocks(text, facts);
    };
    plan.drawn = TRY(with_hit_text(scene, plan.pass, rewrite));
    plan.basis = Basis::measured;
    plan.title = "cycles from the begin to the end of mainImage";
    plan.unit = "cycles";
    return {};
}

constexpr LensClass k_outcomes[] = {{"proved right", {0, 32, 77}},
                                    {"steps over its first hit", {255, 234, 70}},
                                    {"misses it", {255, 255, 255}},
                                    {"undecided", {124, 123, 120}}};

Result<void> plan_proof(const scene::Scene& scene, LensPlan& plan) {
    const auto function = PassFunction::create(scene, scene.passes[plan.pass]);
    if (!function)
        return fail(ErrorCode::load, "the text cannot be analysed: " + function.error().message);
    if (function->loops().empty())
        return fail(ErrorCode::load, words_on_no_march(scene, plan.pass));
    plan.basis = Basis::proved;
    plan.title = "the march against its first hit";
    plan.absent = "no march";
    plan.classes = k_outcomes;
    return {};
}

/// Finds the pass of the lens.
Result<void> choose_pass(const scene::Scene& scene, LensPlan& plan) {
    plan.pass = scene.image_index();
    if (plan.lens.pass.empty() || plan.lens.pass == scene.image().name)
        return {};
    const auto found = std::ranges::find(scene.passes, plan.lens.pass, &scene::Pass::name);
    if (found == scene.passes.end())
        return fail(ErrorCode::usage, fmt::format("--pass {}: the scene has no such pass", plan.lens.pass));
    if (found->kind != scene::PassKind::buffer)
        return fail(ErrorCode::usage,
                    fmt::format("{} is not flat: only Image and buffers have lenses", plan.lens.pass));
    plan.pass = size_t(found - scene.passes.begin());
    plan.of_buffer = true;
    plan.drawn_pass = k_copied_pass;
    return {};
}

/// Plans a lens that compares pictures.
void plan_moves(LensPlan& plan, Basis basis, std::string title) {
    plan.basis = basis;
    plan.title = std::move(title);
    plan.unit = plan.of_buffer ? "of the buffer's numbers" : "steps of 1/255";
    plan.logarithmic = true;
}

Result<void> plan_lens(const scene::Scene& scene, LensPlan& plan, const glsl::WorkWeights& weights) {
    switch (plan.lens.name) {
    case LensName::cost: return plan_cost(scene, plan, weights);
    case LensName::clocks: return plan_clocks(scene, plan);
    case LensName::steps: return plan_steps(scene, plan);
    case LensName::value:
    case LensName::branch: return plan_value(scene, plan);
    case LensName::error:
        plan.drawn = scene;
        plan.drawn_pass = scene.passes[plan.pass].name;
        plan.precision = glsl::Precision::promoted;
        plan_moves(plan, Basis::measured, "float against double");
        return {};
    case LensName::rounding:
        if (plan.of_buffer)
            plan.drawn = with_pass_copy(scene, plan.pass);
        plan_moves(plan, Basis::modelled, "largest change with other arithmetic");
        return {};
    case LensName::proof: return plan_proof(scene, plan);
    }
    return {};
}

} // namespace

std::string reason_of(const Error& error) {
    return error.diagnostics.empty() ? error.message : to_string(error.diagnostics.front());
}

std::string basis_of(const glsl::WorkWeights& weights) {
    return weights.device.empty() ? "weights of the table" : "weights measured on " + weights.device;
}

Result<LensPlan> make_lens(const scene::Scene& scene, const Lens& lens, const glsl::WorkWeights& weights) {
    LensPlan plan;
    plan.lens = lens;
    TRY(choose_pass(scene, plan));
    TRY(plan_lens(scene, plan, weights));
    if (plan.of_buffer)
        plan.title += fmt::format(", {}", lens.pass);
    return plan;
}

render::RenderOptions lens_options(const LensPlan& plan, Extent extent) {
    return {.extent = extent,
            .samples = image::SampleType::f32,
            .pass = plan.drawn_pass,
            .precision = plan.precision,
            .specialise = glsl::Specialise::unreachable};
}

} // namespace tidemark::lab
