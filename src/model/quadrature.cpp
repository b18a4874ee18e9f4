#include "quadrature.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <limits>
#include <stdexcept>

namespace springfold::model {

double integral(const std::function<double(double)>& f, double a, double b) {
  if (a == b) return 0;
  constexpr unsigned halvings = 15;
  constexpr double relative = 4 * std::numeric_limits<double>::epsilon();
  try {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, a, b, halvings,
                                                                         relative);
  } catch (const std::domain_error&) {  // Boost's word for a value that is not finite
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace springfold::model
