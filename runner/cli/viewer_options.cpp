#include "cli/viewer_options.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/gl_context.hpp"
#include "render/renderer.hpp"
#include "render/sound_renderer.hpp"
#include "window/screen.hpp"
#include "window/stage.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace tidemark::cli {

using namespace host;
using namespace window;
using host::resolve;
using window::open_editor;
namespace {

constexpr Extent k_played{16, 16};

/// Seconds. A scene whose first frames are too much for the driver would otherwise be reset for ever.
constexpr double k_shortest_life = 5;

/// Runs in a separate process: does everything once that the screen will do with the driver, in a small size.
/// Reports no errors; the screen's own driver does.
void play(SceneRequest request, const HeldTexts& held, const std::string& pass) {
    request.sets = held.sets;
    request.defines = held.defines;
    request.knobs_may_go = true;
    const auto context = host::HeadlessContext::create();
    if (!context)
        return;
    auto scene = load(request);
    if (!scene)
        return;
    if (scene->find(scene::PassKind::sound))
        if (auto sound = render::SoundRenderer::create(*scene, {}, precision_of(request)))
            sound->draw_rows(0, 1);
    auto renderer = render::Renderer::create(*std::move(scene),
                                             {k_played, image::SampleType::u8, pass, precision_of(request)});
    if (!renderer)
        return;
    renderer->warm_up({});
    renderer->draw({});
    renderer->read_back();
}

/// Returns why the window is not opened again after a driver reset; empty: it is.
std::string why_not_again(const Viewer::Settings& settings, double life) {
    if (!settings.record.empty())
        return fmt::format("the recording is in {}", settings.record.path().string());
    if (settings.frames.input)
        return "the recording cannot continue from there";
    if (life < k_shortest_life)
        return "it happened soon after the start, so the window is not opened again; `tidemark capture "
               "--tile 64` draws this scene in small parts";
    return "";
}

} // namespace

void add_viewer_options(Command command, ViewerOptions& options) {
    add_scene_options(command, options.scene);
    add_precision_options(command, options.scene);
    add_picture_options(command, options.frames);
    command
        .add_option("--record", options.record,
                    "Records mouse and keyboard events, for --input; iTime follows the frame number")
        .type_name("FILE")
        .excludes("--input");
    command.option("--fps").description(
        "Highest frame rate; with --record or --input also the time step: iTime = frame / F");
    command.add_flag("--editor", options.editor,
                     "Draws the unsaved texts of an editor, which `tidemark lsp` sends on standard input");
    add_memory_option(command, options.limits);
}

Result<std::shared_ptr<EditorTexts>> open_editor(ViewerOptions& options) {
    if (!options.editor)
        return nullptr;
    if (options.scene.path == "-")
        return fail(ErrorCode::usage, "--editor: standard input cannot hold the scene, too");
    auto editor = TRY(EditorTexts::open());
    options.scene.files.unsaved = editor->shared();
    return editor;
}

Result<Viewer::Settings> resolve(const ViewerOptions& options, FrameSequence frames,
                                 const std::shared_ptr<EditorTexts>& editor, bool rehearses) {
    const auto limits = TRY(resolve(options.limits));
    Viewer::Settings settings{options.scene, std::move(frames)};
    settings.editor = editor;
    if (rehearses)
        settings.rehearsal = Rehearsal::start(
            [&](const HeldTexts& held) {
                SceneRequest scene = options.scene;
                if (editor)
                    scene.files.unsaved = editor->shared();
                play(std::move(scene), held, options.frames.pass);
            },
            limits.memory);
    settings.record = OutputPath::typed(options.record);
    // A recording must be reproducible, so its date advances with iTime.
    if (options.frames.date || options.by_frames())
        settings.date = settings.frames.state.date;
    if (!settings.record.empty())
        TRY(check_writable(settings.record));
    return settings;
}

Result<int> show(std::optional<Viewer::Settings> first, const OpenScreen& open_screen,
                 const NextScene& next) {
    Interrupt interrupt;
    std::unique_ptr<Screen> held; // between two scenes
    const OpenScreen open = [&](const std::string& title) -> Result<std::unique_ptr<Screen>> {
        if (!held)
            return open_screen(title);
        held->enter();
        return std::move(held);
    };
    const auto choose = [&](const Viewer::Leave& leave) {
        const Interrupt::Waking waking(interrupt, [&] { held->wake(); });
        return next(leave, *held, interrupt);
    };
    if (!first) {
        held = TRY(open_screen("tidemark"));
        first = TRY(choose({}));
    }
    while (first) {
        Viewer::Settings& settings = *first;
        const double opened = now_seconds();
        auto opened_viewer = [&] { // opening a camera may take long; Ctrl-C ends it
            const Interrupt::Immediate immediate(interrupt);
            return Viewer::open(settings, open);
        }();
        if (!opened_viewer && settings.in_gallery && held) {
            say(opened_viewer.error());
            first = TRY(choose({}));
            continue;
        }
        std::optional<Viewer> viewer = TRY(std::move(opened_viewer));
        const auto outcome_of = [&] {
            const Interrupt::Waking waking(interrupt, [&] { viewer->wake(); });
            return viewer->run(interrupt);
        };
        auto outcome = outcome_of();
        if (viewer->busy() && !viewer->leave()) {
            if (!outcome)
                say(outcome.error());
            finish_diagnostics(true);
            ::_exit(outcome ? *outcome : exit_code(outcome.error().code));
        }
        if (outcome && viewer->leave() && next) {
            const Viewer::Leave leave = *viewer->leave();
            held = viewer->release_screen();
            viewer.reset();
            first = TRY(choose(leave));
            continue;
        }
        if (!viewer->was_reset())
            return outcome;
        if (const std::string why = why_not_again(settings, now_seconds() - opened); !why.empty()) {
            outcome.error().message += "; " + why;
            return outcome;
        }
        outcome.error().message += "; opening the window again";
        say(outcome.error());
        settings.left = viewer->state();
        settings.scene = viewer->request();
    }
    return interrupt.requested() ? Interrupt::k_exit_code : 0;
}

} // namespace tidemark::cli
