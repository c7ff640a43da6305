#include "antigrasp/core/exit_code.h"

namespace antigrasp {

int ExitCodeOf(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError&) {
    return kExitBadInput;
  } catch (const Interrupted&) {
    return kExitInterrupted;
  } catch (const SaidElsewhere& said) {
    return said.exit_code();
  } catch (...) {
    return kExitFailure;
  }
}

}  // namespace antigrasp
