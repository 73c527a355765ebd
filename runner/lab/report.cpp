#include "lab/report.hpp"

#include "base/file.hpp"
#include "lab/report_data.hpp"

namespace tidemark::lab {

Result<void> write_report(const std::filesystem::path& folder, Findings& findings) {
    if (auto written = write_file(folder / "points.csv", to_csv(findings.set)); !written)
        return written;
    return write_file(folder / "study.json", to_json(findings.set));
}

} // namespace tidemark::lab
