// [reduction].
#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

void read_reduction(Draft& draft) {
  read_section(draft, "reduction", [&](TableReader& in) {
    StrengthReduction reduction;
    reduction.place = in.place();
    in.read("max_displacement", reduction.max_displacement, positive("of a block's size"),
            Need::optional);
    in.read("tolerance", reduction.tolerance, positive(""), Need::optional);
    if (const auto* value = in.find("factors")) {
      const std::string path = in.path_of("factors");
      const auto* list = array_from(*value, path, 2, "2 factors, [smallest, largest]", in.out());
      if (list && list->size() != 2) {
        in.wrong("factors",
                 "found " + std::to_string(list->size()) + ", must be 2: [smallest, largest]");
      } else if (list) {
        bool known = true;
        for (std::size_t i = 0; i < 2; ++i) {
          const auto factor = real_from((*list)[i], item_path(path, i), positive(""), in.out());
          known = known && factor;
          if (factor) reduction.factors[i] = *factor;
        }
        if (known && !(reduction.factors[0] < reduction.factors[1]))
          in.wrong("factors", "found [" + number_text(reduction.factors[0]) + ", " +
                                  number_text(reduction.factors[1]) +
                                  "], must be [smallest, largest]");
      }
    }
    draft.model.reduction = reduction;
  });
}

}  // namespace rockfold
