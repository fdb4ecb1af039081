#include <slamot/core/run.h>

namespace slamot::core
{
RunResult run(Source& source, Filter& filter, const std::vector<Sink*>& sinks,
              const RunOptions& options)
{
  RunResult result;
  for (Sink* sink : sinks) sink->begin(filter.estimate());
  try
  {
    while (const auto step = source.next())
    {
      const Update update = filter.process(*step);
      for (Sink* sink : sinks) sink->accept(*step, update);
      ++result.steps;
      if (options.onProgress) options.onProgress(result.steps, source.progress());
      if (options.stop && options.stop->load())
      {
        result.interrupted = true;
        break;
      }
    }
  }
  catch (...)
  {
    for (Sink* sink : sinks) sink->finish(false);
    throw;
  }
  for (Sink* sink : sinks) sink->finish(!result.interrupted);
  return result;
}
}  // namespace slamot::core
