#include "hash.h"

#include <slamot/core/Error.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace slamot::study
{
namespace
{
class Fnv1a
{
 public:
  void add(const char* bytes, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
      state_ = (state_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ull;
  }
  [[nodiscard]] std::string digits() const
  {
    std::string out(16, '0');
    for (std::size_t i = 0; i < 16; ++i) out[i] = "0123456789abcdef"[state_ >> (60 - 4 * i) & 15];
    return out;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

void addFile(Fnv1a& hash, const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(1 << 16);
  while (file)
  {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof())
    throw core::Error(core::ExitStatus::kUnreadable, path, "can't be read", "check the path");
}
}  // namespace

std::string hashOf(const std::string& text)
{
  Fnv1a hash;
  hash.add(text.data(), text.size());
  return hash.digits();
}

std::string hashOfFiles(const std::string& file, const std::string& folder)
{
  Fnv1a hash;
  addFile(hash, file);
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) addFile(hash, name);
  return hash.digits();
}
}  // namespace slamot::study
