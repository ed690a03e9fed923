-- Puts a run up, and forgets the runs that nobody has put up for long.
--
-- KEYS[1]  farm:runs: hash from a run's key to the run as JSON
-- KEYS[2]  farm:runs:seen: sorted set of runs' keys; the score is when each was last put up, in seconds of
--          the Unix epoch
-- ARGV[1]  the run's key
-- ARGV[2]  the run as JSON
-- ARGV[3]  seconds after which a run that nobody puts up again is forgotten
-- ARGV[4]  1 to replace a run that is there, 0 to leave it as it is
-- Returns  1 if the run was not there before, 0 if it was

local now = tonumber(redis.call('TIME')[1])
local new = redis.call('HEXISTS', KEYS[1], ARGV[1]) == 0
if new or ARGV[4] == '1' then
    redis.call('HSET', KEYS[1], ARGV[1], ARGV[2])
end
redis.call('ZADD', KEYS[2], now, ARGV[1])

for _, old in ipairs(redis.call('ZRANGEBYSCORE', KEYS[2], '-inf', '(' .. (now - ARGV[3]))) do
    redis.call('HDEL', KEYS[1], old)
    redis.call('ZREM', KEYS[2], old)
end
return new and 1 or 0
