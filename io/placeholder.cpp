namespace conelight::io {}
