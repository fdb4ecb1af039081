#include <slamot/core/run.h>

namespace slamot::core
{
RunResult run(Source& source, Filter& filter, const std::vector<Sink*>& sinks,
              const RunOptions& options)
{
  RunResult result;
  std::size_t begun = 0;
  try
  {
    for (; begun < sinks.size(); ++begun) sinks[begun]->begin(filter.estimate());
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
    for (std::size_t i = 0; i < begun; ++i) sinks[i]->finish(false);
    throw;
  }
  for (Sink* sink : sinks) sink->finish(!result.interrupted);
  return result;
}
}  // namespace slamot::core
