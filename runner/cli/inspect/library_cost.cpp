#include "cli/inspect/library_cost.hpp"

#include "cli/forked.hpp"
#include "image/files/codec_loader.hpp"
#include "lab/statistics.hpp"
#include "sound/sound_library.hpp"

#include <fmt/format.h>
#include <link.h>
#include <sys/resource.h>

#include <sstream>

namespace tidemark::cli {
namespace {

constexpr int k_runs = 5;
constexpr double k_patience = 30; ///< seconds

constexpr OptionalLibrary k_optional_libraries[] = {
    {"OpenImageIO", "tidemark_pictures", [] { static_cast<void>(image::picture_codec()); }},
    {"libsndfile", "libsndfile", [] { static_cast<void>(sound::sound_library()); }},
};

double peak_mebibytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

} // namespace

std::span<const OptionalLibrary> optional_libraries() {
    return k_optional_libraries;
}

bool OptionalLibrary::is_loaded() const {
    const auto visit = [](dl_phdr_info* object, size_t, void* wanted) {
        const auto& library = *static_cast<const OptionalLibrary*>(wanted);
        return int(std::string_view(object->dlpi_name).find(library.file) != std::string_view::npos);
    };
    return ::dl_iterate_phdr(visit, const_cast<OptionalLibrary*>(this)) != 0;
}

Result<LibraryCost> measure_loading(const OptionalLibrary& library, double seconds) {
    const lab::Stopwatch whole;
    std::vector<double> wall, cpu, memory;
    for (int i = 0; i < k_runs && (i == 0 || whole.elapsed().wall < 1e3 * seconds); ++i) {
        const auto child = run_forked(
            [&](const Tell& tell) {
                const double before = peak_mebibytes();
                const lab::Stopwatch watch;
                library.load();
                const lab::Elapsed time = watch.elapsed();
                tell(fmt::format("{} {} {}", time.wall, time.cpu, peak_mebibytes() - before));
            },
            k_patience);
        if (!child)
            return fail(child.error());
        std::istringstream told(child->output);
        if (!(told >> wall.emplace_back() >> cpu.emplace_back() >> memory.emplace_back()))
            return fail(ErrorCode::load, fmt::format("loading {} came to no end", library.name));
    }
    return LibraryCost{{lab::median(wall), lab::median(cpu)}, lab::median(memory)};
}

} // namespace tidemark::cli
