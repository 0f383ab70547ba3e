#include "src/base/place_text.hpp"

#include <gtest/gtest.h>

namespace rockfold {

TEST(PlaceText, IsWholeInMetresToTheMillimetre) {
  EXPECT_EQ(place_text({625000, 5802117.4, -20}), "(625000, 5802117.4, -20)");
  EXPECT_EQ(place_text({412345.12345, 1e9, -1e-9}), "(412345.123, 1000000000, 0)");
  EXPECT_EQ(place_text({1.25, 0, 10.0625}), "(1.25, 0, 10.062)");
  EXPECT_EQ(place_text({}), "(0, 0, 0)");
}

TEST(PlaceText, OfSmallModelsHasFourDigits) {
  EXPECT_EQ(place_text({0.00123456, 0, -0.0005}), "(0.001235, 0, -0.0005)");
  EXPECT_EQ(place_text({0.5, 0.123456, 0}), "(0.5, 0.1235, 0)");
}

}  // namespace rockfold
