#include "cli/sequence.hpp"

#include "base/try.hpp"
#include "cli/output_name.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

namespace tidemark::cli {
namespace fs = std::filesystem;

std::optional<int> frame_of(const fs::path& file, const OutputName& pattern) {
    const std::string name = file.filename().string();
    const auto digit = [&](size_t i) {
        return i < name.size() && std::isdigit(static_cast<unsigned char>(name[i]));
    };
    for (size_t i = 0; i < name.size(); ++i) {
        if (!digit(i) || (i > 0 && digit(i - 1)))
            continue;
        size_t end = i;
        while (digit(end))
            ++end;
        for (size_t begin = i; begin < end; ++begin) { // the pattern may have digits of its own
            int number = 0;
            const auto [last, error] = std::from_chars(name.data() + begin, name.data() + end, number);
            if (error == std::errc{} && pattern.of_frame(number).path().filename() == file.filename())
                return number;
        }
    }
    return std::nullopt;
}

Result<Sequence> find_sequence(std::string_view name) {
    std::error_code ignored;
    if (name.find_first_of("%#") == std::string_view::npos || fs::exists(name, ignored))
        return Sequence{{std::nullopt, fs::path(name)}};
    const auto pattern = TRY(OutputName::parse(name, 2, ""));
    const fs::path folder = pattern.pattern().parent_path();
    Sequence found;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, ignored), end;
         !ignored && entry != end; entry.increment(ignored))
        if (const auto number = frame_of(entry->path(), pattern))
            found[number] = pattern.of_frame(*number).path();
    if (found.empty())
        return fail(ErrorCode::load, fmt::format("there is no file '{}'", name));
    return found;
}

} // namespace tidemark::cli
