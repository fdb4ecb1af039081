#pragma once

#include <slamot/core/run.h>

#include <memory>
#include <string>

namespace slamot::window
{
/// A window that shows a run as it goes on.  Closing it does nothing to the run.
class LiveView : public core::Sink
{
 public:
  /// False once the user has closed it.
  [[nodiscard]] virtual bool isOpen() = 0;
};

/// The module's one function, by the name kOpenLiveView.
/// \param filter the one being run: it must outlive the view.
/// \throws core::Error (kConfig) where no window can be opened.
using OpenLiveView = std::unique_ptr<LiveView>(const std::string& title,
                                               const core::Filter& filter);
inline constexpr const char* kOpenLiveView =
    "slamotOpenLiveView";  ///< symbol of a function of type OpenLiveView
}  // namespace slamot::window
