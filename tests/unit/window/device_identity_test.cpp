#include "host/devices.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace tidemark::host::device_identity_test {

namespace fs = std::filesystem;

/// A kernel's folder in which /dev/null (1:3) belongs to a card at `address`.
class DeviceIdentity : public testing::Test {
protected:
    fs::path numbers_where_null_is(const fs::path& address) {
        const fs::path card = folder_.path() / "devices" / address;
        fs::create_directories(card);
        fs::create_directories(folder_.path() / "char" / "1:3");
        fs::create_directory_symlink(card, folder_.path() / "char" / "1:3" / "device");
        return folder_.path() / "char";
    }

    TemporaryFolder folder_;
};

TEST_F(DeviceIdentity, a_cards_file_gives_its_pci_address) {
    EXPECT_EQ(pci_name("/dev/null", numbers_where_null_is("0000:65:00.0")), "pci:0000:65:00.0");
}

TEST_F(DeviceIdentity, other_buses_have_no_pci_address) {
    EXPECT_EQ(pci_name("/dev/null", numbers_where_null_is("fb.gpu")), std::nullopt);
}

TEST_F(DeviceIdentity, other_files_and_unknown_devices_have_no_name) {
    EXPECT_EQ(pci_name("/dev/no/such/file"), std::nullopt);
    EXPECT_EQ(pci_name("/etc/passwd"), std::nullopt);
    EXPECT_EQ(pci_name("/dev/null", folder_.path()), std::nullopt);
}

TEST(UuidName, has_the_usual_notation) {
    std::array<uint8_t, 16> bytes{};
    std::iota(bytes.begin(), bytes.end(), uint8_t{0xF8});
    EXPECT_EQ(uuid_name(bytes), "uuid:f8f9fafb-fcfd-feff-0001-020304050607");
}

} // namespace tidemark::host::device_identity_test
