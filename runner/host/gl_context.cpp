#include "host/gl_context.hpp"

#include "base/supervision.hpp"
#include "render/gl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace tidemark::host {

namespace {

/// An interface of OpenGL, and the least version that a context must have.
struct Interface {
    EGLenum api;
    EGLint major, minor;
    std::string_view name;
};
constexpr Interface k_desktop{EGL_OPENGL_API, 4, 5, "OpenGL 4.5 core"};
/// Any core profile: to find out which version a driver has that lacks 4.5.
constexpr Interface k_any_desktop{EGL_OPENGL_API, 3, 2, "OpenGL"};
/// 3.1 has program interfaces, which list the uniforms, and sets uniforms of programs.
constexpr Interface k_es{EGL_OPENGL_ES_API, 3, 1, "OpenGL ES 3.1"};

std::vector<EGLint> context_attributes(const Interface& wanted, DebugContext debug, ResetNotice notice) {
    std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION, wanted.major, EGL_CONTEXT_MINOR_VERSION,
                                   wanted.minor};
    if (wanted.api == EGL_OPENGL_API)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
    if (debug == DebugContext::yes)
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    if (notice == ResetNotice::yes)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, reset_strategy(notice)});
    attributes.push_back(EGL_NONE);
    return attributes;
}

} // namespace

int reset_strategy(ResetNotice notice) {
    return notice == ResetNotice::yes ? EGL_LOSE_CONTEXT_ON_RESET : EGL_NO_RESET_NOTIFICATION;
}

Result<SharedContext> SharedContext::create(void* display, void* first, void* surface, ResetNotice notice) {
    EGLint wanted[] = {EGL_CONFIG_ID, 0, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR; // the value of a context without surfaces
    EGLint count = 0;
    eglQueryContext(display, first, EGL_CONFIG_ID, &wanted[1]);
    if (wanted[1] != 0)
        eglChooseConfig(display, wanted, &config, 1, &count);
    EGLint api = EGL_OPENGL_API;
    eglQueryContext(display, first, EGL_CONTEXT_CLIENT_TYPE, &api);
    const std::vector<EGLint> attributes =
        context_attributes(api == EGL_OPENGL_ES_API ? k_es : k_desktop, DebugContext::no, notice);
    eglBindAPI(EGLenum(api)); // each thread has its own setting
    SharedContext made;
    made.display_ = display;
    made.window_ = surface;
    made.context_ = eglCreateContext(display, config, first, attributes.data());
    if (made.context_)
        return made;
    return fail(
        ErrorCode::no_context,
        fmt::format("the driver cannot create a second OpenGL context: EGL error {:#06x}", eglGetError()));
}

SharedContext::SharedContext(SharedContext&& other) noexcept
    : display_(other.display_), window_(other.window_), context_(std::exchange(other.context_, nullptr)) {}

SharedContext& SharedContext::operator=(SharedContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(window_, other.window_);
    std::swap(context_, other.context_);
    return *this;
}

SharedContext::~SharedContext() {
    if (!context_)
        return;
    if (eglGetCurrentContext() == context_)
        leave();
    eglDestroyContext(display_, context_);
}

Result<void> SharedContext::make_current() {
    return make_current_with(EGL_NO_SURFACE);
}

Result<void> SharedContext::make_current_in_window() {
    return make_current_with(window_);
}

Result<void> SharedContext::make_current_with(void* surface) {
    eglBindAPI(EGL_OPENGL_API); // each thread has its own setting
    if (eglMakeCurrent(display_, surface, surface, context_))
        return {};
    return fail(ErrorCode::no_context,
                fmt::format("cannot use a second OpenGL context: EGL error {:#06x}", eglGetError()));
}

void SharedContext::leave() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

KeepCurrent::KeepCurrent()
    : display_(eglGetCurrentDisplay()), context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)), read_(eglGetCurrentSurface(EGL_READ)) {}

KeepCurrent::~KeepCurrent() {
    if (context_)
        eglMakeCurrent(display_, draw_, read_, context_);
    else
        eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

namespace {

/// Returns EGL's name for the last error on this thread.
std::string_view last_egl_error() {
    constexpr std::array<std::string_view, 15> k_names{
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
        "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
        "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST",
    };
    const auto index = size_t(eglGetError()) - EGL_SUCCESS;
    return index < k_names.size() ? k_names[index] : "an unknown EGL error";
}

bool has_word(const char* list, std::string_view word) {
    return list && fmt::format(" {} ", list).find(fmt::format(" {} ", word)) != std::string::npos;
}

template <class Function>
Function egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> egl_devices() {
    const Doing starting("starting OpenGL: listing its devices", Doing::Kind::start);
    const auto query = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query || !query(0, nullptr, &count))
        return {};
    std::vector<EGLDeviceEXT> devices(size_t(count), nullptr);
    if (!query(count, devices.data(), &count))
        return {};
    devices.resize(size_t(count));
    return devices;
}

DeviceKind kind_of(EGLDeviceEXT device) {
    const auto query = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (!query)
        return DeviceKind::unknown;
    const bool software = has_word(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    return software ? DeviceKind::software : DeviceKind::hardware;
}

/// The display must have been initialised.
DeviceKind kind_of_display(EGLDisplay display) {
    const auto query = egl_function<PFNEGLQUERYDISPLAYATTRIBEXTPROC>("eglQueryDisplayAttribEXT");
    EGLAttrib device = 0;
    if (!query || !query(display, EGL_DEVICE_EXT, &device) || device == 0)
        return DeviceKind::unknown;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): EGL hands it out as a number.
    return kind_of(reinterpret_cast<EGLDeviceEXT>(device));
}

/// Returns the names for HeadlessDevice::lasting_names.
std::vector<std::string> lasting_names(EGLDeviceEXT device) {
    std::vector<std::string> names;
    const auto query = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (!query || !device)
        return names;
    const char* extensions = query(device, EGL_EXTENSIONS);
    const auto offers = [&](std::string_view extension) { return has_word(extensions, extension); };
    if (offers("EGL_EXT_device_drm") || offers("EGL_EXT_device_drm_render_node")) {
        const EGLint what =
            offers("EGL_EXT_device_drm_render_node") ? EGL_DRM_RENDER_NODE_FILE_EXT : EGL_DRM_DEVICE_FILE_EXT;
        const char* file = query(device, what);
        if (auto name = file ? pci_name(file) : std::nullopt)
            names.push_back(*std::move(name));
    }
    if (offers("EGL_EXT_device_persistent_id")) {
        const auto binary = egl_function<PFNEGLQUERYDEVICEBINARYEXTPROC>("eglQueryDeviceBinaryEXT");
        std::array<uint8_t, 16> uuid{};
        EGLint size = 0;
        if (binary && binary(device, EGL_DEVICE_UUID_EXT, EGLint(uuid.size()), uuid.data(), &size) &&
            size == EGLint(uuid.size()))
            names.push_back(uuid_name(uuid));
    }
    if (offers("EGL_NV_device_cuda")) {
        const auto attribute = egl_function<PFNEGLQUERYDEVICEATTRIBEXTPROC>("eglQueryDeviceAttribEXT");
        EGLAttrib number = 0;
        if (attribute && attribute(device, EGL_CUDA_DEVICE_NV, &number))
            names.push_back(fmt::format("cuda:{}", number));
    }
    return names;
}

/// A place where a context may be made: the name that users type, and its EGL platform and device.
struct Place {
    std::string name;
    EGLenum platform = EGL_NONE; ///< EGL_NONE: the default display
    EGLDeviceEXT device = nullptr;
    DeviceKind kind = DeviceKind::unknown;
};

/// A driver of Mesa that draws on the CPU. The environment selects it, before EGL is first called.
struct MesaDriver {
    std::string_view name;
    std::array<std::pair<const char*, const char*>, 2> environment;
    std::string_view package; ///< Debian's
};

constexpr std::string_view k_zink = "mesa:zink"; ///< OpenGL on Vulkan

constexpr MesaDriver k_mesa_drivers[] = {
    {"mesa:llvmpipe", {{{"GALLIUM_DRIVER", "llvmpipe"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}}, "libgl1-mesa-dri"},
    {"mesa:softpipe", {{{"GALLIUM_DRIVER", "softpipe"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}}, "libgl1-mesa-dri"},
    {k_zink,
     {{{"MESA_LOADER_DRIVER_OVERRIDE", "zink"}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}},
     "mesa-vulkan-drivers"},
};

const MesaDriver* find_mesa_driver(std::string_view name) {
    const auto found = std::ranges::find(k_mesa_drivers, name, &MesaDriver::name);
    return found == std::end(k_mesa_drivers) ? nullptr : found;
}

/// Lets Mesa load this driver, in this process and its children, and returns the place where it draws.
Place select(const MesaDriver& driver) {
    for (const auto& [name, value] : driver.environment)
        ::setenv(name, value, 1);
    // Vulkan's loader looks for a Wayland display, whose library prints an error if this is not set.
    ::setenv("XDG_RUNTIME_DIR", "/tmp", 0);
    return {std::string(driver.name), EGL_PLATFORM_SURFACELESS_MESA, nullptr, DeviceKind::software};
}

/// Returns every place, in EGL's order.
std::vector<Place> list_places() {
    std::vector<Place> places{{"surfaceless", EGL_PLATFORM_SURFACELESS_MESA}};
    for (EGLDeviceEXT device : egl_devices()) {
        const std::string name = fmt::format("device:{}", places.size() - 1);
        places.push_back({name, EGL_PLATFORM_DEVICE_EXT, device, kind_of(device)});
    }
    places.push_back({"display"});
    return places;
}

/// Returns whether Vulkan has a driver. It is asked before zink starts: without one, Mesa 25's zink waits for
/// ever.
bool has_vulkan_driver() {
    struct InstanceInfo { // VkInstanceCreateInfo, for Vulkan 1.0 without layers and extensions
        int type = 1;
        const void* next = nullptr;
        uint32_t flags = 0;
        const void* application = nullptr;
        uint32_t layer_count = 0;
        const char* const* layers = nullptr;
        uint32_t extension_count = 0;
        const char* const* extensions = nullptr;
    };
    void* const library = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return false;
    const auto create = reinterpret_cast<int (*)(const InstanceInfo*, const void*, void**)>(
        ::dlsym(library, "vkCreateInstance"));
    const auto destroy =
        reinterpret_cast<void (*)(void*, const void*)>(::dlsym(library, "vkDestroyInstance"));
    const InstanceInfo info;
    void* instance = nullptr;
    if (!create || !destroy || create(&info, nullptr, &instance) != 0)
        return false;
    destroy(instance, nullptr);
    return true;
}

/// Returns the place's initialised display, or the reason why there is none. The display is never terminated:
/// EGL returns the same one to every caller in the process, and eglTerminate would end their contexts too.
tl::expected<EGLDisplay, std::string> open_display(const Place& place) {
    const Doing starting(fmt::format("starting OpenGL on '{}'", place.name), Doing::Kind::start);
    EGLDisplay display = place.platform == EGL_NONE
                             ? eglGetDisplay(EGL_DEFAULT_DISPLAY)
                             : eglGetPlatformDisplay(place.platform, place.device, nullptr);
    if (display == EGL_NO_DISPLAY)
        return tl::unexpected(fmt::format("no driver offers it ({})", last_egl_error()));
    if (place.name == k_zink) {
        static const bool has_driver = has_vulkan_driver(); // a display is opened more than once
        if (!has_driver)
            return tl::unexpected(std::string("there is no Vulkan driver"));
    }
    if (!eglInitialize(display, nullptr, nullptr))
        return tl::unexpected(fmt::format("the driver does not start ({})", last_egl_error()));
    return display;
}

/// A context that was made current on this thread; the destructor destroys it.
struct CurrentContext {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    ResetNotice notice = ResetNotice::no;

    CurrentContext(EGLDisplay its_display, EGLContext its_context, ResetNotice its_notice)
        : display(its_display), context(its_context), notice(its_notice) {}
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
    ~CurrentContext() {
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
    bool make_current() const { return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context); }
};

/// Why a place has no context.
struct NoContext {
    enum class Kind {
        no_driver, ///< no driver offers the place, or it does not start
        too_old,   ///< there is a driver, but without the interface that is wanted
        unsuited   ///< it has the interface, but cannot be used
    };
    Kind kind = Kind::no_driver;
    std::string reason;
};

using ContextOrReason = tl::expected<std::unique_ptr<CurrentContext>, NoContext>;

tl::unexpected<NoContext> no_context(NoContext::Kind kind, std::string reason) {
    return tl::unexpected(NoContext{kind, std::move(reason)});
}

EGLContext create_context(EGLDisplay display, const Interface& wanted, DebugContext debug,
                          ResetNotice notice) {
    const std::vector<EGLint> attributes = context_attributes(wanted, debug, notice);
    eglBindAPI(wanted.api);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

/// Returns the GL_VERSION of a context of that kind; empty if the driver makes none.
std::string version_offered(EGLDisplay display, const Interface& wanted) {
    const EGLContext made = create_context(display, wanted, DebugContext::no, ResetNotice::no);
    if (made == EGL_NO_CONTEXT)
        return {};
    const CurrentContext context(display, made, ResetNotice::no);
    return context.make_current() ? gl_string(GL_VERSION) : std::string();
}

/// Says which interfaces the driver has instead of the one that it lacks.
std::string what_is_missing(EGLDisplay display, const Interface& wanted) {
    const std::string error(last_egl_error());
    const std::string desktop = version_offered(display, k_any_desktop);
    const std::string es = wanted.api == EGL_OPENGL_ES_API ? "" : version_offered(display, k_es);
    std::string text = fmt::format("the driver has no {} ({})", wanted.name, error);
    if (!desktop.empty())
        text += fmt::format(", only OpenGL {}", desktop);
    if (!es.empty())
        text += fmt::format("; it has {}: `check --portable` and `capture --es` use that", es);
    return text;
}

/// Makes a context that reports driver resets, if the driver has such contexts.
ContextOrReason make_context(const Place& place, DebugContext debug, const Interface& wanted = k_desktop) {
    const Doing starting(fmt::format("starting OpenGL on '{}'", place.name), Doing::Kind::start);
    const auto display = open_display(place);
    if (!display)
        return no_context(NoContext::Kind::no_driver, display.error());
    const bool offered =
        has_word(eglQueryString(*display, EGL_EXTENSIONS), "EGL_EXT_create_context_robustness");
    auto notice = offered ? ResetNotice::yes : ResetNotice::no;
    EGLContext made = create_context(*display, wanted, debug, notice);
    if (made == EGL_NO_CONTEXT && offered)
        made = create_context(*display, wanted, debug, notice = ResetNotice::no);
    if (made == EGL_NO_CONTEXT)
        return no_context(NoContext::Kind::too_old, what_is_missing(*display, wanted));
    auto context = std::make_unique<CurrentContext>(*display, made, notice);
    if (!context->make_current())
        return no_context(NoContext::Kind::unsuited,
                          fmt::format("the driver cannot draw without a window ({})", last_egl_error()));
    return context;
}

bool is_called(const Place& place, std::string_view name) {
    if (place.name == name)
        return true;
    const bool may_last = name.starts_with("pci:") || name.starts_with("uuid:") || name.starts_with("cuda:");
    return may_last && std::ranges::count(lasting_names(place.device), name) > 0;
}

/// Returns the places that `device` names, in the order to try them; empty for an unknown name.
std::vector<Place> places_to_try(const std::vector<Place>& places, std::string_view device) {
    std::vector<std::string> names{std::string(device)};
    if (device == "auto") {
        std::vector<bool> is_software;
        for (const Place& place : places)
            if (place.platform == EGL_PLATFORM_DEVICE_EXT)
                is_software.push_back(place.kind == DeviceKind::software);
        const bool any_hardware = std::ranges::count(is_software, false) > 0;
        // Only if the answer matters: it starts a driver.
        const auto surfaceless = any_hardware ? open_display(places.front()) : tl::unexpected(std::string());
        names =
            order_to_try(is_software, surfaceless && kind_of_display(*surfaceless) == DeviceKind::software);
    }
    std::vector<Place> chosen;
    for (const std::string& name : names) {
        const auto place =
            std::ranges::find_if(places, [&](const Place& each) { return is_called(each, name); });
        if (place != places.end())
            chosen.push_back(*place);
    }
    return chosen;
}

/// Returns all names for `create`, with the permanent ones.
std::vector<std::string> names_of(const std::vector<Place>& places) {
    std::vector<std::string> names{"auto"};
    for (const Place& place : places) {
        names.push_back(place.name);
        std::ranges::move(lasting_names(place.device), std::back_inserter(names));
    }
    std::ranges::move(mesa_drivers(), std::back_inserter(names));
    return names;
}

tl::unexpected<Error> unknown_device(std::string_view device, const std::vector<Place>& places) {
    return fail(ErrorCode::usage,
                fmt::format("unknown device '{}'; there are {}", device, fmt::join(names_of(places), ", ")));
}

/// The places that were tried, each with the reason why it has no context.
using Tried = std::vector<std::pair<std::string, NoContext>>;

std::string reasons_of(const Tried& tried) {
    std::string text;
    for (const auto& [place, error] : tried)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", place, error.reason);
    return text;
}

/// Returns whether a driver was found, but without the interface that is wanted.
bool has_old_driver(const Tried& tried) {
    return std::ranges::any_of(tried,
                               [](const auto& each) { return each.second.kind == NoContext::Kind::too_old; });
}

tl::unexpected<Error> no_place(const Interface& wanted, const Tried& tried) {
    return fail(ErrorCode::no_context,
                fmt::format("no {} context without a window: {}.{} `tidemark inspect --devices` lists what "
                            "there is",
                            wanted.api == EGL_OPENGL_ES_API ? "OpenGL ES 3.1" : "OpenGL 4.5",
                            reasons_of(tried),
                            has_old_driver(tried)
                                ? ""
                                : " Install a driver (Debian's libgl1-mesa-dri draws on the CPU; a graphics "
                                  "card needs its vendor's EGL driver);"));
}

tl::unexpected<Error> no_mesa_driver(const MesaDriver& driver, const Tried& tried) {
    return fail(ErrorCode::no_context,
                fmt::format("{}.{} `tidemark inspect --devices` lists what there is", reasons_of(tried),
                            has_old_driver(tried)
                                ? std::string()
                                : fmt::format(" It is part of Debian's {};", driver.package)));
}

tl::unexpected<Error> no_gpu(const Tried& tried) {
    return fail(ErrorCode::no_context,
                fmt::format("no graphics card can draw: {}. Check that the vendor's EGL driver is installed "
                            "and works; without --require-gpu the CPU draws",
                            reasons_of(tried)));
}

HeadlessDevice describe(const Place& place) {
    HeadlessDevice device{place.name, place.kind, {}, {}, {}, lasting_names(place.device), {}};
    if (const auto display = open_display(place))
        device.es_version = version_offered(*display, k_es);
    const ContextOrReason context = make_context(place, DebugContext::no);
    if (!context) {
        device.reason = context.error().reason;
        return device;
    }
    if (device.kind == DeviceKind::unknown)
        device.kind = kind_of_display((*context)->display);
    device.renderer = gl_string(GL_RENDERER);
    device.version = gl_string(GL_VERSION);
    // The renderer's name decides: with a display, Mesa 25 reports llvmpipe's surfaceless device as hardware.
    if (gl::is_software_renderer(device.renderer))
        device.kind = DeviceKind::software;
    return device;
}

} // namespace

struct HeadlessContext::State {
    std::unique_ptr<CurrentContext> context;
    std::string device;
};

void compile_for_few_drawings() {
    ::setenv("GALLIVM_PERF", "nopt", 0);
}

HeadlessContext::HeadlessContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

Result<HeadlessContext> HeadlessContext::create(const DeviceChoice& choice, DebugContext debug) {
    const auto [name, es] = split_device_name(choice.name);
    const MesaDriver* const driver = find_mesa_driver(name);
    const std::vector<Place> places = driver ? std::vector{select(*driver)} : list_places();
    const std::vector<Place> chosen = places_to_try(places, name);
    if (chosen.empty())
        return unknown_device(name, places);
    const Interface& wanted = es ? k_es : k_desktop;
    Tried tried;
    for (const Place& place : chosen) {
        ContextOrReason context = make_context(place, debug, wanted);
        // EGL may list a card and still give a CPU renderer: the renderer's own name decides.
        if (context && choice.gpu_only && gl::is_software_renderer(gl_string(GL_RENDERER)))
            context = no_context(NoContext::Kind::unsuited,
                                 fmt::format("draws on the CPU ({})", gl_string(GL_RENDERER)));
        if (context)
            return HeadlessContext(std::make_unique<State>(State{std::move(*context), place.name}));
        tried.emplace_back(place.name, context.error());
    }
    if (choice.gpu_only)
        return no_gpu(tried);
    return driver ? no_mesa_driver(*driver, tried) : no_place(wanted, tried);
}

Result<void> HeadlessContext::make_current() {
    if (!state_->context->make_current())
        return fail(ErrorCode::no_context,
                    fmt::format("cannot use the context of '{}': {}", state_->device, last_egl_error()));
    return {};
}

Result<SharedContext> HeadlessContext::create_context() {
    return SharedContext::create(state_->context->display, state_->context->context, EGL_NO_SURFACE,
                                 state_->context->notice);
}

const std::string& HeadlessContext::device() const {
    return state_->device;
}

std::vector<std::string> device_names() {
    return names_of(list_places());
}

std::vector<std::string> mesa_drivers() {
    std::vector<std::string> names;
    for (const MesaDriver& driver : k_mesa_drivers)
        names.emplace_back(driver.name);
    return names;
}

bool is_mesa_driver(std::string_view name) {
    return find_mesa_driver(name) != nullptr;
}

HeadlessDevice describe_mesa_driver(const std::string& name) {
    return describe(select(*find_mesa_driver(name)));
}

void list_headless_devices(const std::function<void(const HeadlessDevice&, bool tried)>& seen,
                           size_t skipped) {
    const KeepCurrent current;
    for (const Place& place : list_places()) {
        if (skipped > 0) {
            --skipped;
            continue;
        }
        seen({place.name, place.kind, {}, {}, {}, {}, {}}, false);
        seen(describe(place), true);
    }
}

} // namespace tidemark::host
