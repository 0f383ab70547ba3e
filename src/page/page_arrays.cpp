#include "src/page/page_arrays.hpp"

namespace rockfold {

void PageArrays::add(const std::string& name, const char* type, const void* data, std::size_t count,
                     std::size_t size, bool differences) {
  PageArray array{name, type, count, differences, std::vector<std::uint8_t>(count * size)};
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < size; ++k) array.shuffled[k * count + i] = bytes[i * size + k];
  list_.push_back(std::move(array));
}

std::size_t PageArrays::bytes() const {
  std::size_t sum = 0;
  for (const PageArray& array : list_) sum += array.shuffled.size();
  return sum;
}

}  // namespace rockfold
