#pragma once

#include <string>
#include <vector>

namespace sigmascape::product {

struct ZipEntry {
  std::string name, content;
};

/// A ZIP archive, nothing compressed, all entries dated 1980-01-01: equal entries give equal bytes. What NumPy calls
/// .npz is such an archive of .npy files. Throws Error, naming `where` and what to do instead, when it would pass
/// 4 GiB, which plain ZIP cannot hold.
[[nodiscard]] std::string zip_bytes(const std::vector<ZipEntry>& entries, const std::string& where,
                                    const std::string& instead);

}  // namespace sigmascape::product
